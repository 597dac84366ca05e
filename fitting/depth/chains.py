"""Whether chains have seen enough: effective sample size and R-hat, of ranks.

R-hat of split chains and of ranks as Vehtari, Gelman, Simpson, Carpenter and Buerkner have it (Bayesian
Analysis 16, 2021, Eq. 1 to 4, 14); the effective size by emcee's integrated autocorrelation time.
"""

import numpy as np
from scipy.special import ndtri

from fitting.arrays import Array


def r_hat(chains: Array) -> float:
    """How far the chains of one quantity are from agreeing: 1 where they do. Shape (chains, steps)."""
    # Loaded where it is needed, as in data/hum.py: a sixth of the start of every process.
    from scipy.stats import rankdata

    half = chains.shape[1] // 2
    split = np.concatenate([chains[:, :half], chains[:, -half:]])
    ranks = rankdata(split).reshape(split.shape)
    z = ndtri((ranks - 3 / 8) / (ranks.size + 1 / 4))
    within = z.var(axis=1, ddof=1).mean()
    between = z.mean(axis=1).var(ddof=1)
    return float(np.sqrt((half - 1) / half + between / within)) if within > 0 else float("nan")
