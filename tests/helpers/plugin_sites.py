"""Packages put where Python finds installed ones, without a registry or a network."""

import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

from fitting.plugins import TOLD

ROOT = Path(__file__).parents[2]
EXAMPLES = ROOT / "examples"
_GIVEN = os.environ.get("PYTHONPATH")


def install(source: Path, site: Path) -> None:
    """As an installer leaves a package: its sources, and metadata made of its pyproject.toml."""
    project = tomllib.loads((source / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (package,) = [p.parent for p in source.glob("*/__init__.py")]
    shutil.copytree(package, site / package.name, ignore=shutil.ignore_patterns("__pycache__"))
    describe(site, project["name"], project["version"], project["entry-points"])


def describe(site: Path, name: str, version: str, entries: dict[str, dict[str, str]]) -> None:
    folder = site / f"{name.replace('-', '_')}-{version}.dist-info"
    folder.mkdir(parents=True)
    (folder / "METADATA").write_text(f"Metadata-Version: 2.1\nName: {name}\nVersion: {version}\n")
    lines = [
        line
        for group, named in entries.items()
        for line in (f"[{group}]", *(f"{entry} = {place}" for entry, place in named.items()), "")
    ]
    (folder / "entry_points.txt").write_text("\n".join(lines))


def python_path(site: Path) -> str:
    """PYTHONPATH of a process that is to find the packages of a site."""
    return os.pathsep.join([str(site), str(ROOT), *filter(None, [_GIVEN])])


def python(site: Path, folder: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    """Run in a folder, with the packages of a site installed."""
    return subprocess.run(
        [sys.executable, *arguments],
        cwd=folder,
        env={**os.environ, "PYTHONPATH": python_path(site), TOLD: ""},
        capture_output=True,
        text=True,
        timeout=600,
    )
