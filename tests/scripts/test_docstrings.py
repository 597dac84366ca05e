import subprocess
import sys
from pathlib import Path

SCRIPT = Path(__file__).parents[2] / "scripts" / "docstrings.py"


def looked_at(root, source):
    (root / "fitting").mkdir()
    (root / "fitting" / "one.py").write_text(source, encoding="utf-8")
    done = subprocess.run([sys.executable, SCRIPT, root], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout.splitlines()


def test_an_array_without_a_shape_and_an_unsaid_error_are_told_with_their_places(tmp_path):
    source = '''
def twice(x: Array) -> Array:
    """Both."""
    if not len(x):
        raise ValueError("nothing")
    return 2 * x
'''
    assert looked_at(tmp_path, source) == (
        1,
        [
            "fitting/one.py:2: twice states no shape",
            "fitting/one.py:2: twice does not say that it raises ValueError",
        ],
    )


def test_what_is_said_once_holds_for_overrides_for_protocols_and_within_a_class(tmp_path):
    source = '''
class Law:
    def modulus(self, omega: Array) -> Array:
        """G* in Pa. Shape of `omega`. Raises `ValueError` below zero."""

class Constant(Law):
    def modulus(self, omega: Array) -> Array:
        raise ValueError

class Reader(Protocol):
    def read(self) -> Array:
        """Shape (samples,)."""

class Card:
    def read(self) -> Array:
        """By what it is like, whatever that may be."""

class Sweep:
    """Columns of shape (points,)."""

    def velocity(self) -> Array:
        """In m/s."""

def _inner(x: Array) -> Array:
    return x
'''
    assert looked_at(tmp_path, source) == (0, [])


def test_a_number_of_the_inference_has_a_reason(tmp_path):
    source = '_ROUNDS, _FAR = 3, -1e-3\nWORDS = "no number"\n_STEPS = 2 * 5\n"""A bound."""\n'
    assert looked_at(tmp_path, source) == (1, ["fitting/one.py:1: (_ROUNDS, _FAR) has no reason"])


def test_shapes_of_an_element_count_no_degrees_of_freedom(tmp_path):
    source = '''
def stiffness() -> Array:
    """One element's. Shape (parts, 28, 28)."""

def mass() -> Array:
    """One element's. Shape (4 dofs, 4 dofs); bending adds t^2 / (36 kappa^2)."""
'''
    status, said = looked_at(tmp_path, source)
    assert status == 1
    assert [line.split(":")[1] for line in said] == ["3"]


def test_a_docstring_that_begins_with_a_fragment_is_told_with_it(tmp_path):
    source = '''
class Pairs:
    """Of one search. Others are elsewhere."""

    def wait(self) -> None:
        """It goes on."""

class Follows:
    """As `Pairs`."""

def law() -> str:
    """By the paper's Eq. (20), which needs no mode."""

def _inner() -> None:
    """Of one."""
'''
    status, said = looked_at(tmp_path, source)
    assert status == 1
    assert said == [
        "fitting/one.py:2: Pairs begins with a fragment: Of one search. Others are elsewhere.",
        "fitting/one.py:5: Pairs.wait begins with a fragment: It goes on.",
    ]


LEANING = '''
class Beam:
    """The same of a beam, without the width."""

    def moved(self) -> None:
        """As `Plate.moved`, for a beam."""

def those(x: int) -> int:
    """Those that are left of what was given."""

def thatched() -> None:
    """Thatched roofs carry snow: `that` is another word."""
'''


def test_a_docstring_that_leans_on_another_names_it(tmp_path):
    assert looked_at(tmp_path, LEANING) == (
        1,
        [
            "fitting/one.py:2: Beam leans on what it does not name: The same of a beam, without the width.",
            "fitting/one.py:8: those leans on what it does not name: Those that are left of what was given.",
        ],
    )


def test_leave_to_lean_is_given_by_name_and_taken_back_where_it_is_not_needed(tmp_path):
    (tmp_path / "scripts").mkdir()
    leave = tmp_path / "scripts" / "leaning_docstrings.txt"
    leave.write_text("fitting/one.py:Beam\nfitting/one.py:those\nfitting/two.py:gone\n", encoding="utf-8")
    assert looked_at(tmp_path, LEANING) == (
        1,
        ["fitting/two.py:gone leans on nothing any more: take it off scripts/leaning_docstrings.txt"],
    )
