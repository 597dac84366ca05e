"""The examples run as they stand, each in a process of its own and without a screen."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

pytestmark = pytest.mark.usefixtures("warm")

FOLDER = Path(__file__).parents[2] / "examples"
EXAMPLES = sorted(FOLDER.glob("*.py"))
LONGEST_S = 15.0
_CROWDED = 6
"""Times slower where other tests run beside it."""


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_an_example_runs_as_it_stands(path, tmp_path):
    if path.stem == "simulated_rig" and os.name != "posix":
        pytest.skip("the simulated rig needs pseudo-terminals")
    done = subprocess.run(
        [sys.executable, str(path)],
        cwd=tmp_path,
        env={**os.environ, "MPLBACKEND": "Agg", "TMPDIR": str(tmp_path)},
        capture_output=True,
        text=True,
        timeout=_CROWDED * LONGEST_S,
    )
    assert done.returncode == 0, done.stderr
    assert "Warning" not in done.stderr


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_the_gallery_names_it(path):
    assert f"]({path.name})" in (FOLDER / "README.md").read_text(encoding="utf-8")


def test_from_arrays_to_a_law_in_eight_lines():
    lines = (FOLDER / "arrays_to_law.py").read_text(encoding="utf-8").splitlines()
    assert len([line for line in lines if line and not line.startswith(("#", '"""'))]) == 8
