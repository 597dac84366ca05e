"""A case on disk as a lab would hand it in: data.csv, specimen.toml, hammer.json; and truth.json."""

import json
from pathlib import Path
from typing import Any

from instrument.campaign.noise import NoiseFigures
from instrument.campaign.plates.cases import PlateCase, PlateTruth
from instrument.campaign.plates.geometry import plate_named
from instrument.campaign.plates.hammer import HammerTest
from instrument.campaign.plates.hidden import HIDDEN
from instrument.campaign.plates.materials import PlateMaterialLaw
from instrument.campaign.plates.noise import PlateNoise
from instrument.campaign.plates.simulate import ChannelError
from instrument.campaign.plates.stated import specimen_from
from instrument.files.hammer_file import read_hammer
from instrument.files.sweep_file import read_sweep, sweep_text
from instrument.files.text import read_text

DATA, SPECIMEN, HAMMER, TRUTH = "data.csv", "specimen.toml", "hammer.json", "truth.json"


def save_case(case: PlateCase, folder: Path) -> Path:
    """Its files in a folder of its own, which is made; the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / DATA).write_text(sweep_text(case.sweep, case.specimen.base_acceleration_m_s2), encoding="utf-8")
    (folder / SPECIMEN).write_text(case.specimen_toml, encoding="utf-8")
    if case.hammer_test is not None:
        _write(folder / HAMMER, case.hammer_test.facts)
    facts = {"kind": case.kind, "seed": case.seed, "exact": case.exact, **case.truth.facts}
    _write(folder / TRUTH, facts)
    return folder


def load_case(folder: Path) -> PlateCase:
    """A case that `save_case` wrote. Raises `BadInput`."""
    facts = json.loads(read_text(folder / TRUTH))
    text = read_text(folder / SPECIMEN)
    specimen = specimen_from(text)
    test = None
    if (folder / HAMMER).exists():
        struck = read_hammer(folder / HAMMER)
        test = HammerTest(struck.frequency_hz, struck.ratios)
    sweep = read_sweep(folder / DATA).sweep(specimen.base_acceleration_m_s2)
    return PlateCase(facts["kind"], facts["seed"], facts["exact"], sweep, specimen, text, test, _truth(facts))


def _truth(facts: dict[str, Any]) -> PlateTruth:
    noise = dict(facts["noise"])
    white = NoiseFigures(noise.pop("fraction_of_peak"), noise.pop("repeat_scatter"))
    return PlateTruth(
        plate=plate_named(facts["plate"]),
        effects=tuple(HIDDEN[name](**severity) for name, severity in facts["effects"].items()),
        law=PlateMaterialLaw(facts["law"]["kind"], tuple(facts["law"]["values"])),
        noise=PlateNoise(white, **noise),
        channel=ChannelError(**facts["channel"]),
        resonances_hz=tuple(facts["resonances_hz"]),
        lowest_share=facts["lowest_share"],
    )


def _write(path: Path, facts: dict[str, Any]) -> None:
    path.write_text(json.dumps(facts, indent=1) + "\n", encoding="utf-8")
