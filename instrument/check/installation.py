"""Whether viscorig itself is in order: versions, what it writes to, the window's libraries, serial ports."""

import os
import platform
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path

import h5py
import numpy as np
from packaging.requirements import Requirement
from serial.tools.list_ports import comports

from fitting.plugins import told
from instrument.errors import system_words
from instrument.facts.doctor import Finding, State
from instrument.models.cache import cache_folder

_PACKAGE = "viscorig"
_WINDOW_S = 60.0
"""Longest wait for the window's libraries to be loaded."""
_LEAST_FREE_BYTES = 10**9
_TRY_WINDOW = "from PySide6.QtWidgets import QApplication; import pyqtgraph, tomlkit; QApplication([])"
_LIBRARIES = "Debian, Ubuntu: apt-get install libegl1 libgl1 libxkbcommon0 libdbus-1-3 libfontconfig1"


def look_at_installation() -> Iterator[Finding]:
    """All that can be known without a rig, one by one."""
    yield _said("Python", "good", f"{platform.python_version()}, {platform.platform(terse=True)}")
    yield from _packages()
    yield _sessions_can_be_written()
    yield _cache()
    yield _room()
    yield from (_said("plugin", "fault", words, "mend or uninstall that package") for words in told())
    yield _qt()
    yield _screen()
    yield from _serial_ports()


def _said(name: str, state: State, found: str, cure: str = "", group: str = "installation") -> Finding:
    return Finding.model_validate(
        {"group": group, "name": name, "state": state, "found": found, "cure": cure}
    )


def _packages() -> Iterator[Finding]:
    """Versions against the ranges that viscorig was tested with."""
    try:
        stated = [Requirement(text) for text in requires(_PACKAGE) or ()]
        own = version(_PACKAGE)
    except PackageNotFoundError:
        yield _said(_PACKAGE, "fault", "run from its sources, not installed", "pip install .")
        return
    yield _said(_PACKAGE, "good", own)
    for one in stated:
        if one.marker is None or one.marker.evaluate({"extra": ""}):
            yield _package(one)


def _package(wanted: Requirement) -> Finding:
    cure = f"pip install '{wanted}'"
    try:
        there = version(wanted.name)
    except PackageNotFoundError:
        return _said(wanted.name, "fault", "not there", cure)
    if there in wanted.specifier:
        return _said(wanted.name, "good", there)
    return _said(wanted.name, "fault", f"{there}, tested with {wanted.specifier}", cure)


def _sessions_can_be_written() -> Finding:
    """A small file written and read again."""
    what = f"h5py {h5py.version.version}, HDF5 {h5py.version.hdf5_version}"
    values = np.arange(4.0)
    try:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "try.h5"
            with h5py.File(path, "w") as file:
                file["values"] = values
            with h5py.File(path, "r") as file:
                same = bool(np.array_equal(file["values"][()], values))
    except OSError as error:
        return _said("HDF5", "fault", f"{what}: {error}", "TMPDIR=a folder that can be written to")
    if not same:
        return _said("HDF5", "fault", f"{what}: read other numbers than were written", "reinstall h5py")
    return _said("HDF5", "good", f"{what}, written and read")


def _cache() -> Finding:
    folder = cache_folder()
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=folder):
            pass
    except OSError as error:
        cure = "VISCORIG_CACHE=a folder that can be written to; without one models are computed each time"
        return _said("cache", "remark", f"{folder}: {system_words(error)}", cure)
    size = sum(path.stat().st_size for path in folder.glob("*.npz"))
    return _said("cache", "good", f"{folder}, {size / 1e6:.0f} MB")


def _room() -> Finding:
    free = shutil.disk_usage(Path.cwd()).free
    found = f"{free / 1e9:.1f} GB free here"
    if free < _LEAST_FREE_BYTES:
        return _said("disk", "remark", found, "an hour of a run takes some 160 MB: make room")
    return _said("disk", "good", found)


def _qt() -> Finding:
    """Loaded in a process of its own: Qt ends the program where its libraries do not fit."""
    try:
        tried = subprocess.run(
            [sys.executable, "-c", _TRY_WINDOW],
            env=os.environ | {"QT_QPA_PLATFORM": "offscreen"},
            capture_output=True,
            text=True,
            timeout=_WINDOW_S,
            check=False,
        )
    except subprocess.TimeoutExpired:
        return _said("Qt", "remark", f"not loaded in {_WINDOW_S:g} s", "try again", "window")
    if tried.returncode == 0:
        return _said("Qt", "good", f"PySide6-Essentials {version('PySide6-Essentials')}", group="window")
    last = (tried.stderr.strip().splitlines() or ["it ended without a word"])[-1]
    cure = "pip install 'viscorig[gui]'" if "No module named" in last else _LIBRARIES
    return _said("Qt", "remark", last, cure, "window")


def _screen() -> Finding:
    if not sys.platform.startswith("linux"):
        return _said("screen", "good", "the system's own", group="window")
    there = {name: os.environ[name] for name in ("WAYLAND_DISPLAY", "DISPLAY") if os.environ.get(name)}
    if there:
        return _said("screen", "good", ", ".join(f"{k}={v}" for k, v in there.items()), group="window")
    cure = "the command line needs none; for `viscorig gui` log in on a desktop, or use ssh -X"
    return _said("screen", "remark", "DISPLAY and WAYLAND_DISPLAY are not set", cure, "window")


def _serial_ports() -> Iterator[Finding]:
    ports = sorted(comports(), key=lambda port: port.device)
    if not ports:
        cure = "plug in the adapter of the vibrometer, where it is on one"
        yield _said("serial ports", "remark", "none", cure, "instruments")
    for port in ports:
        what = f"{port.description or 'unnamed'}"
        if os.name == "posix" and not os.access(port.device, os.R_OK | os.W_OK):
            cure = "sudo usermod -aG dialout $USER, then log in again"
            yield _said(port.device, "remark", f"{what}: no right to use it", cure, "instruments")
        else:
            yield _said(port.device, "good", what, group="instruments")
