"""Every module of a room is imported by a test of its own room."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

TESTS = Path(__file__).parent
HELPERS = TESTS / "helpers"
ROOT = TESTS.parent
ROOMS = ("viscorig", "instrument", "drivers", "gui", "fitting", "campaign")


def module_of(path):
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def parsed(path):
    return ast.parse(path.read_text(encoding="utf-8"))


@cache
def modules(room):
    """By name; a package with nothing but a docstring has nothing to test."""
    return {
        module_of(path): path
        for path in sorted((ROOT / room).rglob("*.py"))
        if path.name != "__init__.py" or any(not isinstance(node, ast.Expr) for node in parsed(path).body)
    }


_PLACE = re.compile(r"[a-z_][\w.]*(:\w+)?")


@cache
def imports(path):
    """(module, name or "") of every import and of `module.name`; modules in strings, as importlib has."""
    nodes, found, called = list(ast.walk(parsed(path))), set(), {}
    for node in nodes:
        if isinstance(node, ast.Import):
            found |= {(alias.name, "") for alias in node.names}
            called |= {alias.asname or alias.name: alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module:
            found |= {(node.module, alias.name) for alias in node.names}
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and _PLACE.fullmatch(node.value):
            found.add((node.value.partition(":")[0], ""))
    of_names = (n for n in nodes if isinstance(n, ast.Attribute) and isinstance(n.value, ast.Name))
    return found | {(called[n.value.id], n.attr) for n in of_names if n.value.id in called}


def reached(room, module, name):
    """The modules that an import names: itself, one inside it, or the one a package has the name from."""
    known = modules(room)
    yield module
    yield f"{module}.{name}"
    if module in known and known[module].name == "__init__.py":
        yield from (origin for origin, given in imports(known[module]) if given == name)


def files_of(room):
    """The room's tests, the fixtures of all rooms, and what of the tests' own helpers they import."""
    waiting, found = [TESTS / "conftest.py", *(TESTS / room).rglob("*.py")], set()
    while waiting:
        path = waiting.pop()
        if path not in found:
            found.add(path)
            waiting += [p for module, _ in imports(path) if (p := HELPERS / f"{module}.py").is_file()]
    return found


def without_a_test(room):
    said = {pair for path in files_of(room) for pair in imports(path)}
    return set(modules(room)) - {m for module, name in said for m in reached(room, module, name)}


@pytest.mark.parametrize("room", ROOMS)
def test_a_module_comes_with_a_test_of_its_room(room):
    assert sorted(without_a_test(room)) == []
