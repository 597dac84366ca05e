import numpy as np
import pytest
from scipy.integrate import solve_ivp

from drivers.simulated.plant import effects as e
from drivers.simulated.plant.bare import Pulse, StruckPlate
from drivers.simulated.plant.specimen import BARE_MODAL_RATIOS

HIT, SENSOR = (0.28, 0.02), (0.06, 0.06)


def test_frequencies_and_ratios_are_the_plate_s():
    frequency_hz, ratio = StruckPlate(HIT, SENSOR).modes(9)
    known = [17.72, 59.8, 110.1, 201.6, 275.0, 316.0]
    np.testing.assert_allclose(frequency_hz[:6], known, rtol=1.6e-3)
    np.testing.assert_allclose(ratio, [*BARE_MODAL_RATIOS, 0.001], rtol=1e-6)


def test_a_sensor_lowers_frequencies():
    without, laden = (
        StruckPlate(HIT, (0.28, 0.1)).modes(6)[0],
        StruckPlate(HIT, (0.28, 0.1), 0.002).modes(6)[0],
    )
    assert (laden < without * (1 + 1e-9)).all()
    assert laden[0] < 0.99 * without[0]


def test_modes_reach_beyond_two_kilohertz():
    assert StruckPlate(HIT, SENSOR).modes(100)[0][-1] > 2200


def test_a_blow_agrees_with_an_independent_integration():
    plate = StruckPlate(HIT, SENSOR, sensor_kg=0.001)
    s, pulse = plate.structure, Pulse(0.00123, 0.0008, 120.0)
    plate.strike(pulse)
    t = 1e-4 * np.arange(1, 200)
    force, acceleration = plate.at(t[0], 1e-4, len(t))
    inside = (t >= pulse.begin_s) & (t < pulse.begin_s + pulse.width_s)
    wanted = np.where(inside, 60.0 * (1 - np.cos(2 * np.pi * (t - pulse.begin_s) / pulse.width_s)), 0.0)
    np.testing.assert_allclose(force, wanted, atol=1e-9)
    n = len(s.M)

    def rate(t, x, f):
        push = f * 60.0 * (1 - np.cos(2 * np.pi * (t - pulse.begin_s) / pulse.width_s))
        a = np.linalg.solve(s.M, s.loads[:, 0] * push - s.C @ x[n:] - s.K @ x[:n])
        return np.concatenate([x[n:], a])

    x, found = np.zeros(2 * n), {}
    for begin, end, f in ((pulse.begin_s, pulse.begin_s + 0.0008, 1), (pulse.begin_s + 0.0008, t[-1], 0)):
        asked = t[(t > begin) & (t < end) | (t == t[-1]) & (f == 0)]
        run = solve_ivp(
            rate,
            (begin, end),
            x,
            "DOP853",
            t_eval=[*asked[asked < end], end],
            args=(f,),
            rtol=1e-10,
            atol=1e-14,
        )
        found |= {
            round(at, 9): s.readings[0] @ rate(at, y, f)[n:] for at, y in zip(run.t, run.y.T, strict=True)
        }
        x = run.y[:, -1]
    other = np.array([found.get(round(at, 9), 0.0) for at in t])
    assert np.abs(acceleration - other).max() < 1e-6 * np.abs(other).max()


def test_a_double_hit_is_the_sum_of_two():
    pulses = Pulse(0.01, 0.001, 100.0), Pulse(0.0104, 0.0015, 30.0)
    both, one, two = (StruckPlate(HIT, SENSOR) for _ in range(3))
    for pulse in pulses:
        both.strike(pulse)
    one.strike(pulses[0])
    two.strike(pulses[1])
    a, b, c = (plate.at(0.0, 1 / 48000, 4800) for plate in (both, one, two))
    np.testing.assert_allclose(a, b + c, atol=1e-9 * np.abs(a).max())


def test_the_record_s_spectrum_is_the_accelerance():
    plate = StruckPlate(HIT, SENSOR, effects=e.Effects(viscous_damping=e.ViscousDamping(40.0)))
    plate.strike(Pulse(0.0101, 0.0007, 80.0))
    force, acceleration = plate.at(0.0, 1 / 20000, 20000 * 2)
    frequency_hz = np.fft.rfftfreq(len(force), 1 / 20000)
    for line in np.searchsorted(frequency_hz, [15.0, 60.0, 300.0]):
        ratio = np.fft.rfft(acceleration)[line] / np.fft.rfft(force)[line]
        assert ratio == pytest.approx(plate.accelerance(frequency_hz[line]), rel=2e-3)


def test_a_blow_in_the_past_is_refused():
    plate = StruckPlate(HIT, SENSOR)
    plate.at(0.0, 1e-3, 100)
    with pytest.raises(ValueError, match="already read"):
        plate.strike(Pulse(0.05, 0.001, 100.0))


@pytest.mark.parametrize(
    ("effects", "direction"),
    [
        (e.Effects(air_added_mass=e.AirAddedMass(1.2)), -1),
        (e.Effects(substrate_stiffness=e.SubstrateStiffness(1.05)), 1),
        (e.Effects(e.ClampCompliance(2.8e13, 2.8e13)), -1),
    ],
)
def test_effects_on_the_bare_plate(effects, direction):
    moved = StruckPlate(HIT, SENSOR, effects=effects).modes(1)[0] / StruckPlate(HIT, SENSOR).modes(1)[0]
    assert direction * (moved[0] - 1) > 1e-3
