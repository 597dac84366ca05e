"""Cases on disk: NAME.csv and NAME.hammer.json as the commands read them, NAME.json with the truth beside."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from fitting.sweep import Sweep
from instrument.campaign.cases import Case, Truth, nominal_specimen
from instrument.campaign.materials import TrueLaw
from instrument.campaign.noise import NoiseFigures
from instrument.files.hammer_file import read_hammer
from instrument.files.sweep_file import read_sweep, sweep_text


def write_csv(case: Case, path: Path) -> None:
    """The sweep alone, as `viscorig` reads it."""
    path.write_text(sweep_text(case.sweep, case.specimen.base_acceleration_m_s2), encoding="utf-8")


def save_case(case: Case, folder: Path, name: str) -> Path:
    """NAME.csv, NAME.json and, where there was a hammer test, NAME.hammer.json; the path of NAME.json."""
    folder.mkdir(parents=True, exist_ok=True)
    write_csv(case, folder / f"{name}.csv")
    truth = {"effects": case.truth.effects, "law": asdict(case.truth.law), "noise": asdict(case.truth.noise)}
    if case.hammer is not None:
        modes = [{"frequency_hz": f, "damping_ratio": r} for f, r in zip(*case.hammer, strict=True)]
        _write_json(folder / f"{name}.hammer.json", {"modes": modes})
    path = folder / f"{name}.json"
    _write_json(path, {"kind": case.kind, "seed": case.seed, "truth": truth})
    return path


def _write_json(path: Path, facts: dict[str, Any]) -> None:
    path.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")


def load_case(path: Path) -> Case:
    """A case that `save_case` wrote, by its NAME.json or NAME.csv."""
    facts = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    specimen, truth = nominal_specimen(), facts["truth"]
    sweep: Sweep = read_sweep(path.with_suffix(".csv")).sweep(specimen.base_acceleration_m_s2)
    test = path.with_suffix(".hammer.json")
    struck = read_hammer(test) if test.exists() else None
    hammer = (struck.frequency_hz, struck.ratios) if struck else None
    law = TrueLaw(truth["law"]["kind"], tuple(truth["law"]["values"]))
    hidden = Truth(truth["effects"], law, NoiseFigures(**truth["noise"]))
    return Case(facts["kind"], facts["seed"], sweep, specimen, hammer, hidden)
