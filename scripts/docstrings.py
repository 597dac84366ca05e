"""What docstrings leave out: the shape of arrays, errors raised, and why a number is what it is.

    python scripts/docstrings.py [ROOT]

A public function that takes or returns an array states a shape, one that raises says so. An override of a
documented method of the project needs neither, nor does what a Protocol of the project asks for; a class may
state the shapes of its methods. A named number of `fitting` has a line with its reason below it, and shapes
there call an element's degrees of freedom 4 dofs. A public docstring begins with a sentence that can be read
by itself, not with a fragment such as "Of one search." or "It goes on."; one that leans on another ("The same
of beams.") names it in backticks in that sentence. Exits 1 where something is missing, a line each.
"""

import ast
import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import chain, pairwise
from pathlib import Path

ROOMS = ("fitting", "drivers", "instrument", "gui", "viscorig", "campaign")
KEPT = {f"drivers/simulated/plant/{name}.py" for name in ("air", "grid", "specimen", "strips")}
"""plate.npz carries a digest of their text: a docstring more would make it another plate."""

FRAGMENTS = {
    "drivers/front_end/driver.py: FrontEndOptions",
    "drivers/vibrometer/driver.py: VibrometerOptions",
    "instrument/files/experiment_file.py: SweepTable",
    "instrument/files/rig_file.py: ResponseSection",
}
"""Fragments that stay, as forms of the window show them for headings; this list may only get shorter."""
_OPENS = {"Of", "As", "What", "The", "By", "It"}
"""Words that a fragment begins with: it leans on the name below it."""
_FEW = 4
"""Words up to which a sentence that begins so says nothing by itself."""
_LEANING = re.compile(r"(The same|Itself|Those|Whose|That|One of|As)\b")
"""Beginnings that lean on another docstring, which stands elsewhere where this one is shown."""
LEAVE = "scripts/leaning_docstrings.txt"
"""Those that lean and may stay so: a line `path:name` each. This list may only get shorter."""
_FIRST = re.compile(r"(?<!Eq\.)(?<!Fig\.)(?<=\.)\s|\n\n")

_ARRAY = re.compile(r"\b(Array|Complex|Mask|Indices|Integers|Names|NDArray|ndarray)\b")
_SHAPE = re.compile(r"\b[Ss]hapes?\b|\([\w ]+,\)|\(\w+(, [\w ]+)+\)|\bper (point|line|sample|mode)\b")
_RAISES = re.compile(r"\b([Rr]aise|[Rr]efuse)")
_OF_AN_ELEMENT = re.compile(r"\(([\w ]+, )*(28|36)(, [\w ]+)*,?\)")
_NOT_REFUSALS = {"NotImplementedError", "AssertionError"}

_NAMED = re.compile(r"[A-Z_0-9(), ]+")
_AROUND_NUMBERS = (ast.Tuple, ast.UnaryOp, ast.BinOp, ast.operator, ast.unaryop, ast.expr_context)

Function = ast.FunctionDef | ast.AsyncFunctionDef


@dataclass(frozen=True)
class Class:
    """A class as it is written."""

    node: ast.ClassDef

    @property
    def bases(self) -> list[str]:
        """Their names, without module and parameters."""
        return [re.split(r"[\[.]", ast.unparse(base).partition("[")[0])[-1] for base in self.node.bases]

    @property
    def members(self) -> set[str]:
        """Public names in its body."""
        names = {item.name for item in self.node.body if isinstance(item, Function)}
        fields = {ast.unparse(item.target) for item in self.node.body if isinstance(item, ast.AnnAssign)}
        return {name for name in names | fields if not name.startswith("_")}

    def method(self, name: str) -> Function | None:
        """The one of that name in its body."""
        return next((m for m in self.node.body if isinstance(m, Function) and m.name == name), None)


def missing(root: Path) -> list[str]:
    """A line for every statement that is left out in the rooms under `root`."""
    trees = {
        file.relative_to(root).as_posix(): ast.parse(file.read_text("utf-8"))
        for room in ROOMS
        for file in sorted(root.glob(f"{room}/**/*.py"))
    }
    walked = (node for tree in trees.values() for node in ast.walk(tree))
    classes = {node.name: Class(node) for node in walked if isinstance(node, ast.ClassDef)}
    functions = [
        f"{file}:{node.lineno}: {node.name} {complaint}"
        for file, tree in trees.items()
        if file not in KEPT
        for node, owner in _public(tree.body)
        for complaint in _complaints(node, owner, classes)
    ]
    numbers = [
        f"{file}:{line}: {name} has no reason"
        for file, tree in trees.items()
        if file.startswith("fitting/")
        for line, name in _bare_numbers(tree.body)
    ]
    literal = [
        f"{file}:{line}: states 28 or 36 for an element's degrees of freedom, expected 4 dofs (`Mesh.dofs`)"
        for file, tree in trees.items()
        if file.startswith("fitting/")
        for line, text in _texts(tree)
        if _OF_AN_ELEMENT.search(text)
    ]
    return functions + numbers + literal + _fragments(trees) + _leaning(trees, root / LEAVE)


def _leaning(trees: dict[str, ast.Module], leave: Path) -> list[str]:
    """Public classes and functions whose docstring leans on one that it does not name, and needless leave."""
    said = "leans on what it does not name"
    found = {
        f"{file}:{name}": f"{file}:{node.lineno}: {name} {said}: {text.splitlines()[0]}"
        for file, tree in trees.items()
        if file not in KEPT
        for node, name in _named(tree.body)
        if _leans(text := ast.get_docstring(node) or "")
    }
    kept = leave.read_text("utf-8").splitlines() if leave.is_file() else []
    gone = [f"{key} leans on nothing any more: take it off {LEAVE}" for key in kept if key not in found]
    return [line for key, line in found.items() if key not in kept] + gone


def _leans(text: str) -> bool:
    return bool(_LEANING.match(text)) and "`" not in _FIRST.split(text, maxsplit=1)[0]


def _fragments(trees: dict[str, ast.Module]) -> list[str]:
    """Public classes and functions whose docstring begins with a fragment, and needless leave for them."""
    found = {
        f"{file}: {name}": f"{file}:{node.lineno}: {name} begins with a fragment: {text.splitlines()[0]}"
        for file, tree in trees.items()
        if file not in KEPT
        for node, name in _named(tree.body)
        if _is_fragment(text := ast.get_docstring(node) or "")
    }
    gone = [f"{key} is no fragment any more: take it off FRAGMENTS" for key in sorted(FRAGMENTS - set(found))]
    read = {key.partition(":")[0] for key in FRAGMENTS} & set(trees)
    left = [line for line in gone if line.partition(":")[0] in read]
    return [line for key, line in found.items() if key not in FRAGMENTS] + left


def _is_fragment(text: str) -> bool:
    """A reference to what another docstring says, ("As `look`."), is none."""
    words = _FIRST.split(text, maxsplit=1)[0].split()
    return bool(words) and words[0] in _OPENS and len(words) <= _FEW and not text.startswith("As `")


def _named(body: list[ast.stmt], of: str = "") -> Iterator[tuple[ast.ClassDef | Function, str]]:
    """Public classes, and functions in them and beside them, each with its name."""
    for node in body:
        if isinstance(node, ast.ClassDef | Function) and not node.name.startswith("_"):
            yield node, of + node.name
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from _named(node.body, f"{of}{node.name}.")


def _texts(tree: ast.Module) -> Iterator[tuple[int, str]]:
    """Docstrings, those of fields and names too, each with its line."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant):
            yield node.lineno, str(node.value.value)


def _bare_numbers(body: list[ast.stmt]) -> Iterator[tuple[int, str]]:
    """Numbers, or tuples of them, under names in capitals that no text follows."""
    for statement, following in pairwise([*body, ast.Pass()]):
        if not isinstance(statement, ast.Assign) or isinstance(following, ast.Expr):
            continue
        name = ast.unparse(statement.targets[0])
        if _NAMED.fullmatch(name) and all(map(_numeric, ast.walk(statement.value))):
            yield statement.lineno, name


def _numeric(node: ast.AST) -> bool:
    return isinstance(node, _AROUND_NUMBERS) or (
        isinstance(node, ast.Constant) and isinstance(node.value, int | float | complex)
    )


def _public(body: list[ast.stmt], owner: Class | None = None) -> Iterator[tuple[Function, Class | None]]:
    for node in body:
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            yield from _public(node.body, Class(node))
        elif isinstance(node, Function) and not node.name.startswith("_"):
            yield node, owner


def _complaints(node: Function, owner: Class | None, classes: dict[str, Class]) -> Iterator[str]:
    if any(re.search(r"overload|command", ast.unparse(decorator)) for decorator in node.decorator_list):
        return  # a command's docstring is its --help
    signature = f"{ast.unparse(node.args)} -> {ast.unparse(node.returns) if node.returns else ''}"
    if _ARRAY.search(signature) and not _stated(_SHAPE, node, owner, classes):
        yield "states no shape"
    raised = sorted(set(_raised(node)))
    if raised and not _stated(_RAISES, node, owner, classes):
        yield f"does not say that it raises {', '.join(raised)}"


def _stated(what: re.Pattern[str], node: Function, owner: Class | None, classes: dict[str, Class]) -> bool:
    own = [node, owner.node] if owner else [node]
    places = chain(own, _overridden(node.name, owner, classes) if owner else ())
    return any(what.search(ast.get_docstring(place) or "") for place in places)


def _overridden(name: str, owner: Class, classes: dict[str, Class]) -> Iterator[Function]:
    """The methods of this name in what a class is derived from, and in the protocols that it fits."""
    ancestors = list(_ancestors(owner, classes))
    members = {member for each in (owner, *ancestors) for member in each.members}
    protocols = (each for each in classes.values() if "Protocol" in each.bases)
    for each in chain(ancestors, (p for p in protocols if name in p.members <= members)):
        method = each.method(name)
        if method is not None:
            yield method


def _ancestors(owner: Class, classes: dict[str, Class]) -> Iterator[Class]:
    for base in owner.bases:
        if base in classes:
            yield classes[base]
            yield from _ancestors(classes[base], classes)


def _raised(node: Function) -> Iterator[str]:
    for inner in ast.walk(node):
        if isinstance(inner, ast.Raise) and inner.exc is not None:
            error = inner.exc.func if isinstance(inner.exc, ast.Call) else inner.exc
            name = ast.unparse(error)
            if (name[0].isupper() or "." in name) and name not in _NOT_REFUSALS:
                yield name


def main() -> int:
    """Say what is missing."""
    found = missing(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parents[1])
    print("\n".join(found), end="\n" if found else "")
    return bool(found)


if __name__ == "__main__":
    sys.exit(main())
