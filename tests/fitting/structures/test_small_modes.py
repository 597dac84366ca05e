"""Modes of a beam beside those of a rod: what stretches it does not bend it."""

import numpy as np
import pytest
from beam_cases import BEAM

from fitting.structures import Beam
from fitting.structures.small_modes import along, small_modes
from instrument.files.structure_file import read_structure


def test_the_mode_that_goes_along_a_clamped_beam_is_a_rod_s(tmp_path):
    path = tmp_path / "beam.toml"
    path.write_text(BEAM)
    beam = read_structure(path)
    assert isinstance(beam, Beam)
    modes = small_modes(beam, beam.core.law, 12)
    (first, *_) = (m for m, goes in zip(modes, along(beam, modes), strict=True) if goes)
    # A rod clamped at one end: a quarter of a wave, of faces and core together.
    layers = [beam.substrate, *((beam.constraining,) if beam.constraining else ())]
    stiff = sum(f.young_pa * f.thickness_m for f in layers)
    heavy = sum(f.density_kg_m3 * f.thickness_m for f in layers)
    heavy += beam.core.density_kg_m3 * beam.core.thickness_m
    assert first.frequency_hz == pytest.approx(np.sqrt(stiff / heavy) / (4 * beam.length_m), rel=0.02)
    assert not any(along(beam, modes)[:3])
