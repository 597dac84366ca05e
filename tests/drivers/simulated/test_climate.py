import numpy as np
import pytest
from scipy.integrate import solve_ivp

from drivers.errors import Refused
from drivers.simulated.climate import AMBIENT_C, HIGHEST_C, Climate
from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant.effects import Effects, OtherLaw
from drivers.simulated.plant.law import ZN1, wlf_shift
from drivers.simulated.plant.shaken import ShakenPlate
from drivers.simulated.plates import DampedPlate


@pytest.mark.parametrize("times_s", [(120.0, 300.0), (50.0, 50.0)])
def test_air_and_plate_are_the_solution_of_their_equations(times_s):
    climate = Climate(*times_s)
    climate.go_to(100.0, 40.0)
    climate.go_to(400.0, 5.0)
    air_s, plate_s = times_s

    def rates(t, y):
        goal = AMBIENT_C if t < 100 else 40.0 if t < 400 else 5.0
        return [(goal - y[0]) / air_s, (y[0] - y[1]) / plate_s]

    found = solve_ivp(rates, (0, 900), [AMBIENT_C] * 2, max_step=2.0, rtol=1e-8, t_eval=np.arange(0, 900, 50))
    for t, air, plate in zip(found.t, *found.y, strict=True):
        assert climate.air_c(t) == pytest.approx(air, abs=1e-3)
        assert climate.plate_c(t) == pytest.approx(plate, abs=1e-3)


def test_what_it_cannot_reach_is_refused():
    climate = Climate()
    with pytest.raises(Refused, match="expected 0 to 50"):
        climate.go_to(0.0, HIGHEST_C + 1)
    assert climate.set_point_c == AMBIENT_C


def test_the_core_follows_by_time_temperature_superposition():
    climate = Climate(1.0, 1.0)
    climate.go_to(0.0, 35.0)
    warm = ShakenPlate(climate=climate)
    warm.drive(DrivePiece(100.0, 20.0, 1.0, 0.0, 0.0))
    shifted = ShakenPlate(Effects(core_law=OtherLaw(ZN1.shifted(wlf_shift(35.0 - AMBIENT_C, 9.0, 120.0)))))
    for f in (18.0, 60.0, 110.0, 300.0):
        stated, found = (p.steady_state(f)["spot_velocity"] for p in (shifted, warm))
        assert found == pytest.approx(stated, rel=2e-4)


def test_a_thermometer_on_the_plate_reads_the_plate():
    climate = Climate(1.0, 2.0)
    climate.go_to(0.0, 35.0)
    plate = DampedPlate(Effects(), climate)
    assert plate.at("temperature", 3.0, 1.0, 2) == pytest.approx([climate.plate_c(3.0), climate.plate_c(4.0)])
