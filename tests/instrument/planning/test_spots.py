"""Where else a plate could be read: rows of other spots."""

from dataclasses import replace

import numpy as np

from fitting.plate.plate import Plate
from fitting.stated.patches import Patch
from instrument.files.specimen_file import read_specimen
from instrument.paper_case import case_file
from instrument.planning.spots import spot_row


def test_another_spot_reads_the_motions_that_the_plate_carries_patched_on_one_side_or_struck():
    stated = replace(read_specimen(case_file("zn1.toml")), elements=(8, 8))
    aside = replace(stated, patches=(Patch(0.02, 0.16, 0.03, 0.15),))
    struck = replace(stated, boundary="free", force_m=(0.02, 0.02))
    for specimen in (stated, aside, struck):
        plate = Plate(specimen)
        V = np.random.default_rng(0).normal(size=(plate.carried.shape[1], 3))
        spot_m = (0.2, 0.15)
        np.testing.assert_allclose(spot_row(plate, V, spot_m), plate.observe(*spot_m) @ (plate.carried @ V))
