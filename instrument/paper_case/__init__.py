"""The published case the application starts from: a plate with a ZN_1 core.

Geometry of Table 1 (substrate 68.9 GPa), ratios of Table 3, responses of Table 5, law of Table 4.
"""

from importlib.resources import as_file, files
from pathlib import Path

from fitting.laws.fractional_zener import FractionalZener

TABLE_4 = FractionalZener(g0_pa=0.27e6, ginf_pa=4.1e6, tau_s=1.21e-4, alpha=0.83)
"""The law the paper identified."""

TABLE_5_THEORY_M_S = (0.0708, 0.1128, 0.0729, 0.0206, 0.0276, 0.0229, 0.0086, 0.0109, 0.0088)
"""The paper's own theory at Table 5's frequencies."""


def case_file(name: str) -> Path:
    """A file of this case: zn1.toml, isd112.toml or table5.csv."""
    with as_file(files(__name__) / name) as path:
        return path
