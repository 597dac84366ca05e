"""Which g is meant is said by name."""

import re

import pytest
from data_folder import DATA

from fitting.gravity import PUBLISHED_G_M_S2, STANDARD_GRAVITY_M_S2

ROOT = DATA.parent.parent


def test_the_published_level_is_not_the_standard_one():
    assert (PUBLISHED_G_M_S2, STANDARD_GRAVITY_M_S2) == (9.81, 9.80665)


@pytest.mark.parametrize("package", ["fitting", "instrument", "drivers", "gui", "viscorig", "scripts"])
def test_no_other_source_writes_either_number(package):
    bare = [
        f"{path.relative_to(ROOT)}:{number}: {line.strip()}"
        for path in sorted((ROOT / package).rglob("*.py"))
        if path != ROOT / "fitting" / "gravity.py"
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), start=1)
        if re.search(r"\b9\.81\b|\b9\.80665\b", line)
    ]
    assert not bare, "\n".join(bare)
