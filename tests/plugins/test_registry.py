"""What is found, in which order, and what is left out with one line."""

import logging
import subprocess
import sys

import pytest
from plugin_sites import ROOT

from fitting import plugins
from fitting.plugins import NoPlugin, Registry
from instrument.cli.main import run
from instrument.interchange.readers import READERS

GOOD = "def read(path):\n    return 'read'\n"
BROKEN = "import no_such_library\n"


def judged(name, found):
    if not callable(found):
        raise NoPlugin("it is no function")
    return found


def readers(**own):
    return Registry("viscorig.readers", {"own": len, **own}, judged)


def said(caplog):
    return [r.getMessage() for r in caplog.records if r.name == "fitting.plugins"]


@pytest.fixture(autouse=True)
def _listening(caplog):
    caplog.set_level(logging.WARNING)


def test_another_packages_is_found_by_its_name_after_our_own(package, caplog):
    package("good-one", GOOD, readers={"dat": "read"})
    found = readers()
    assert list(found) == ["own", "dat"]
    assert found["dat"](None) == "read"
    assert (found.is_own("own"), found.is_own("dat")) == (True, False)
    assert said(caplog) == []


def test_names_are_known_without_importing_anything(package):
    package("broken-one", BROKEN, readers={"dat": "read"})
    assert [(e.name, plugins.package_of(e)) for e in plugins.others()] == [("dat", ("broken-one", "1.2"))]
    assert plugins.packages() == {"broken-one": "1.2"}
    assert "plugin_broken_one" not in sys.modules


def test_one_is_loaded_when_it_is_asked_for(package):
    package("first", GOOD, readers={"one": "read"})
    package("second", GOOD, readers={"two": "read"})
    assert readers()["two"]
    assert "plugin_second" in sys.modules
    assert "plugin_first" not in sys.modules


def test_our_own_may_be_imported_when_asked_for(nothing_told):
    assert readers(late="json:loads")["late"]("[1]") == [1]


@pytest.mark.parametrize(
    ("text", "attribute", "why"),
    [
        (BROKEN, "read", "ModuleNotFoundError: No module named 'no_such_library'"),
        (GOOD, "write", "AttributeError: module 'plugin_bad_one' has no attribute 'write'"),
        ("read = 3\n", "read", "it is no function"),
        ("raise KeyError('of\\nits own')\n", "read", "KeyError: 'of"),
        ("raise SystemExit(7)\n", "read", "SystemExit: 7"),
    ],
)
def test_what_cannot_be_used_is_left_out_with_one_line_that_names_it(package, caplog, text, attribute, why):
    package("bad-one", text, readers={"dat": attribute})
    package("good-one", GOOD, readers={"txt": "read"})
    found = readers()
    assert list(found) == ["own", "txt"]
    assert "dat" not in found
    (line,) = said(caplog)
    assert line.startswith("plugin 'dat' of package bad-one (viscorig.readers) is left out: " + why)
    assert "\n" not in line
    assert why in found.expected("dat")


def test_the_lines_in_the_documentation_are_those_that_are_said(package, caplog):
    page = (ROOT / "docs" / "plugins.md").read_text(encoding="utf-8")
    shown = [line.strip() for line in page.splitlines() if line.startswith("    plugin ")]
    assert len(shown) == 2
    package("other-readers", BROKEN, readers={"dat": "read", "xls": "read"})
    own = {name: len for name in READERS if READERS.is_own(name)}
    list(Registry("viscorig.readers", own, judged))
    assert said(caplog) == shown


def test_a_name_that_is_ours_stays_ours(package, caplog):
    package("greedy", GOOD, readers={"own": "read"})
    assert readers()["own"] is len
    assert said(caplog) == [
        "plugin 'own' of package greedy (viscorig.readers) is left out: "
        "viscorig itself has a file reader of this name"
    ]


def test_the_version_says_what_will_be_left_out_and_imports_none_of_it(package, capsys):
    package("broken-one", BROKEN, readers={"dat": "read", "odd": "read"}, laws={"odd": "Law"})
    package("zebra", BROKEN, readers={"odd": "read"}, commands={"run": "run"})
    assert run(["--version"]) == 0
    assert capsys.readouterr().out.splitlines()[1:] == [
        "  core law odd, from broken-one 1.2",
        "  file reader dat, from broken-one 1.2: left out, viscorig itself has a file reader of this name",
        "  file reader odd, from broken-one 1.2",
        "  file reader odd, from zebra 1.2: left out, package broken-one has a file reader of this name",
        "  command run, from zebra 1.2: left out, viscorig itself has a command of this name",
    ]
    assert not {"plugin_broken_one", "plugin_zebra"} & set(sys.modules)


def test_of_two_packages_the_first_by_name_has_it(package, caplog):
    package("zebra", "def read(path):\n    return 'zebra'\n", readers={"dat": "read"})
    package("aardvark", "def read(path):\n    return 'aardvark'\n", readers={"dat": "read"})
    assert readers()["dat"](None) == "aardvark"
    (line,) = said(caplog)
    assert "of package zebra" in line
    assert "package aardvark has a file reader of this name" in line


def test_it_is_said_once_and_not_again_by_a_process_that_is_started(package, caplog):
    package("bad-one", BROKEN, readers={"dat": "read"})
    list(readers())
    list(readers())
    assert len(said(caplog)) == 1
    asks = "from instrument.interchange.readers import READERS; list(READERS)"
    child = subprocess.run([sys.executable, "-c", asks], capture_output=True, text=True, check=True)
    assert child.stderr == ""


def test_one_that_fails_at_its_work_is_left_out_from_then_on(package, caplog):
    package("good-one", GOOD, readers={"dat": "read"})
    found = readers()
    assert "dat" in found
    found.leave_out("dat", RuntimeError("no more"))
    assert "dat" not in found
    assert "RuntimeError: no more" in said(caplog)[0]
