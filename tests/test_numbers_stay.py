"""What the commands compute stays what it was, to the bit: moved modules and new names change no number.

Kept by the code before the move (`kept_numbers.py` says how, and what counts as equal on another machine).
"""

import hashlib
import json
import lzma
import shutil

import numpy as np
import pytest
from data_folder import DATA
from kept_numbers import KEPT, differences, lasting, store, storing
from threadpoolctl import threadpool_limits

from fitting.identification.result import REFERENCE_FREQUENCIES_HZ
from instrument.cli.main import run

SUMS, FITTED, SEARCHED, VAGUE = 1e-9, 1e-5, 1e-4, 5e-3
"""Relative, on machines that round otherwise: sums and products; where an optimiser ends; a search of fits,
some along flat directions; an iteration that is stopped before it ends, and standard errors read off a rest
that is next to nothing."""

CASES = {
    "identify-direct": ("identify table5.csv --specimen coarse.toml", FITTED),
    "identify-paper": ("identify table5.csv --specimen coarse.toml --method paper", VAGUE),
    "identify-pointwise": ("identify thin.csv --specimen coarse.toml --pointwise", FITTED),
    "identify-session": ("identify small.h5", FITTED),
    "diagnose-nine-points": ("diagnose table5.csv --specimen coarse.toml --resamples 0", SEARCHED),
    "diagnose-sweep": ("diagnose thin.csv --specimen coarse.toml", SEARCHED),
    "damping": ("damping hits.csv", VAGUE),
}
RATE, SECONDS = 2048.0, 4.0
MODES = ((17.7, 0.0029, 1.0), (59.8, 0.0013, -0.9), (110.1, 0.0018, 0.8))
"""Frequency in Hz, damping ratio, amplitude."""
ROWS = 400
"""Of an exported file, about, are kept; the digest is of the whole text."""


@pytest.fixture(scope="module")
def files(tmp_path_factory):
    """A folder with what the commands are given."""
    folder = tmp_path_factory.mktemp("given")
    for name in ("coarse.toml", "table5.csv"):
        shutil.copy(KEPT / name, folder)
    sweep = (DATA / "practice-005.csv").read_text().splitlines()
    (folder / "thin.csv").write_text("\n".join([sweep[0], *sweep[1::8]]) + "\n")
    (folder / "small.h5").write_bytes(lzma.decompress((KEPT / "small.h5.xz").read_bytes()))
    write_hits(folder / "hits.csv")
    return folder


def write_hits(path, count=3):
    """Blows of 1 ms, decaying modes, noise on both; rounded, and so the same on every machine."""
    t = np.arange(-0.05, SECONDS, 1 / RATE)
    rng = np.random.default_rng(7)
    lines = [f"# sample_rate_hz: {RATE}", "hit,force_n,acceleration_m_s2"]
    for hit in range(1, count + 1):
        noise = rng.normal(size=(2, len(t)))
        force = 100 * np.sin(np.pi * t / 1e-3) * ((t >= 0) & (t < 1e-3)) + 0.02 * noise[0]
        response = ringing(np.maximum(t - 5e-4, 0)) + 0.002 * noise[1]
        lines += [f"{hit},{f:.6f},{x:.6f}" for f, x in zip(force, response, strict=True)]
    path.write_text("\n".join(lines) + "\n")


def ringing(since):
    """After a blow; nothing at its moment."""
    return sum(
        a * np.exp(-2 * np.pi * f * ratio * since) * np.sin(2 * np.pi * f * since) for f, ratio, a in MODES
    )


def facts(capsys, *arguments):
    """A command's JSON, on one thread: sums in another order would differ in the last bit."""
    with threadpool_limits(1, "blas"):
        status = run([*arguments, "--json", "-"])
    captured = capsys.readouterr()
    assert status == 0, captured.err
    return lasting(json.loads(captured.out))


def assert_kept(name, found, tolerance):
    if storing():
        store(name, found)
        pytest.skip("stored anew")
    apart = differences(name, found, tolerance)
    assert not apart, "\n".join(apart)


@pytest.mark.parametrize("name", CASES)
def test_a_command_says_the_same_numbers(capsys, monkeypatch, files, name):
    monkeypatch.chdir(files)
    line, tolerance = CASES[name]
    found = facts(capsys, *line.split())
    assert_kept(name, found, tolerance)


def test_a_recorded_session_replays_to_the_same_events(capsys, monkeypatch, files):
    monkeypatch.chdir(files)
    found = facts(capsys, "replay", "small.h5")
    # Derived events are read otherwise than by the program that recorded it; what they are now is kept below.
    found.pop("equal_to_recorded")
    found.pop("differences")
    assert found["derived_events"] > 90
    assert found.pop("result")["law"] == at_references(found)
    assert_kept("replay", found, SEARCHED)


def test_a_recorded_session_is_exported_as_the_same_text(capsys, monkeypatch, files, tmp_path):
    monkeypatch.chdir(files)
    facts(capsys, "export", "small.h5", "--to", "csv", "--out", str(tmp_path))
    # The law to sign is written since: its numbers are those of the replay above.
    kept = [path for path in sorted(tmp_path.iterdir()) if not path.name.endswith("-result.json")]
    found = {path.name: said_in(path.read_text()) for path in kept}
    assert len(found) == 5
    assert_kept("export", found, SUMS)


def at_references(found):
    return [r for r in found["diagnose"]["after"]["law"] if r["frequency_hz"] in REFERENCE_FREQUENCIES_HZ]


def said_in(text):
    """Of a text its digest, how long it is and a good part of it, numbers as such."""
    lines = text.splitlines()
    part = lines[:: 1 + len(lines) // ROWS]
    cells = [[number_or_word(cell) for cell in line.split(",")] for line in part]
    return {"sha256": hashlib.sha256(text.encode()).hexdigest(), "lines": len(lines), "cells": cells}


def number_or_word(cell):
    try:
        return float(cell)
    except ValueError:
        return cell
