"""Numbers of the commands, kept so that a change of structure can be shown to change none of them.

`tests/data/numbers/NAME.json.xz` holds what a command said, in full precision, with a SHA-256 over it and a
fingerprint of the arithmetic it was computed with. Where the arithmetic is the same the digest must be too:
equal to the bit. Elsewhere another BLAS kernel adds in another order: numbers must agree within a tolerance,
relative to the number or to the largest one of that name, words apart from the figures in them, and `LOOSE`
is not compared.

Store anew, after a change that is meant to change numbers:

    VISCORIG_KEEP_NUMBERS=1 .venv/bin/pytest tests/test_numbers_stay.py

`small.h5.xz` beside them is a session, recorded from the files in `tests/data/numbers/run`. It needs
recording anew only where sessions of then may no longer be read; the numbers then too:

    export VISCORIG_PROCESSES=1 OPENBLAS_NUM_THREADS=1
    .venv/bin/viscorig run tests/data/numbers/run/small.toml --out out
    xz -9e < out/small-*.h5 > tests/data/numbers/small.h5.xz

`xz -dc FILE.json.xz` shows what is kept.
"""

import hashlib
import json
import lzma
import os
import platform
import re
from collections import defaultdict
from functools import cache

import numpy as np
import scipy
import scipy.linalg  # its BLAS is loaded, and so part of the fingerprint
from data_folder import DATA
from threadpoolctl import threadpool_info, threadpool_limits

KEPT = DATA / "numbers"
STORE = "VISCORIG_KEEP_NUMBERS"
LOOSE = {"iterations", "evaluations", "sha256"}
"""Not compared where the arithmetic is another: how often an optimiser went round, and digests of texts."""
_MOST = 10


def fingerprint():
    """What the last bit of a number depends on, besides the code."""
    blas = {
        " ".join(str(p.get(key)) for key in ("internal_api", "version", "architecture"))
        for p in threadpool_info()
        if p["user_api"] == "blas"
    }
    return {
        "machine": platform.machine(),
        "libc": " ".join(platform.libc_ver()),
        "python": ".".join(platform.python_version_tuple()[:2]),
        "numpy": np.__version__,
        "scipy": scipy.__version__,
        "simd": np.show_config(mode="dicts")["SIMD Extensions"].get("found", []),
        "blas": sorted(blas),
        "probe": probe(),
    }


@cache
def probe():
    """A digest of sums, a solution, modes and functions: kernels of one name add by the size of a cache."""
    rng = np.random.default_rng(11)
    A, x = rng.standard_normal((2, 301, 203)), rng.standard_normal(4001)
    with threadpool_limits(1, "blas"):
        product = A[0] @ A[1].T
        lossy = product[:160, :160] + 1j * product[100:260, 100:260]
        found = [
            product,
            np.linalg.solve(lossy, A[0][:160].astype(complex)),
            scipy.linalg.eigh(A[0].T @ A[0])[1],
            np.linalg.eig(lossy[:40, :40])[0],
            np.exp(x),
            np.sin(x) * np.abs(x) ** 0.3,
            np.fft.rfft(x),
        ]
    return hashlib.sha256(b"".join(np.ascontiguousarray(one).tobytes() for one in found)).hexdigest()


def lasting(facts):
    """Facts without how long it took, and without what the posterior beside it says in another form.

    What a measurement will take is computed, and stays.
    """
    if isinstance(facts, dict):
        return {
            k: lasting(v)
            for k, v in facts.items()
            if (not re.search(r"(^|_)seconds$", k) or "needs_hands" in facts) and k != "law_known"
        }
    return [lasting(v) for v in facts] if isinstance(facts, list) else facts


def digest(facts):
    """Equal where every number is, to the bit: JSON says floats so that they come back."""
    return hashlib.sha256(json.dumps(facts, sort_keys=True).encode()).hexdigest()


def store(name, facts):
    """Keep the facts of a case."""
    kept = {"fingerprint": fingerprint(), "sha256": digest(facts), "facts": facts}
    with lzma.open(KEPT / f"{name}.json.xz", "wt", preset=9 | lzma.PRESET_EXTREME) as file:
        json.dump(kept, file, separators=(",", ":"))


def load(name):
    """What is kept of a case: fingerprint, sha256, facts."""
    with lzma.open(KEPT / f"{name}.json.xz", "rt") as file:
        return json.load(file)


def same_arithmetic(name):
    """Whether a case was kept on a machine like this one."""
    return load(name)["fingerprint"] == fingerprint()


def storing():
    """Whether numbers are to be kept and not compared."""
    return bool(os.environ.get(STORE))


def differences(name, facts, tolerance):
    """Where facts are not those kept; the first few, one line each."""
    kept = load(name)
    if not same_arithmetic(name):
        return _apart(kept["facts"], facts, tolerance)[:_MOST]
    if digest(facts) == kept["sha256"]:
        return []
    return _apart(kept["facts"], facts, None)[:_MOST] or ["the digest alone"]


def _apart(kept, found, tolerance):
    """Unequal leaves. Without a tolerance every bit counts."""
    ours, theirs = dict(_leaves(kept)), dict(_leaves(found))
    sizes = _sizes(ours)
    said = [f"{p}: {'only kept' if p in ours else 'not kept'}" for p in sorted(ours.keys() ^ theirs.keys())]
    for path in (p for p in ours if p in theirs):
        if not _alike(ours[path], theirs[path], tolerance, sizes.get(_name(path), 0.0), path):
            said.append(f"{path}: {ours[path]!r:.60} kept, {theirs[path]!r:.60} found")
    return said


def _alike(kept, found, tolerance, size, path):
    if tolerance is None:
        return repr(kept) == repr(found)
    if path.rpartition("/")[2] in LOOSE:
        return True
    if _is_number(kept) and _is_number(found):
        return abs(found - kept) <= tolerance * max(abs(kept), size)
    if isinstance(kept, str) and isinstance(found, str):
        return _wording(kept) == _wording(found)
    return kept == found


def _leaves(facts, path=""):
    """Path and value of everything that is not a container, and of empty containers."""
    if isinstance(facts, dict | list) and facts:
        items = facts.items() if isinstance(facts, dict) else enumerate(facts)
        for key, value in items:
            yield from _leaves(value, f"{path}/{key}")
    else:
        yield path, facts


def _sizes(leaves):
    """The largest number of each name: a difference of two numbers is as good as they are."""
    sizes = defaultdict(float)
    for path, value in leaves.items():
        if _is_number(value) and abs(value) < float("inf"):
            sizes[_name(path)] = max(sizes[_name(path)], abs(value))
    return sizes


def _name(path):
    """A path without places in lists."""
    return re.sub(r"/\d+(?=/|$)", "/", path)


def _is_number(value):
    return isinstance(value, int | float) and not isinstance(value, bool)


def _wording(text):
    return re.sub(r"\d+", "#", text)
