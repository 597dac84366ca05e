import numpy as np
import pytest
from scipy.integrate import solve_ivp

from drivers.simulated.drive import DrivePiece
from drivers.simulated.plant import effects as e
from drivers.simulated.plant.one_thread import one_thread
from drivers.simulated.plant.shaken import OUTPUTS, ShakenPlate
from drivers.simulated.plant.shaker import ShakerChain, ShakerMode

TWO_PIECES = (DrivePiece(0.0, 55.0, 0.2, 4.0, 0.3), DrivePiece(0.0312345, 90.0, 1.0, -3.0, -0.7))
ALL_IN_ONE = e.Effects(
    clamp_compliance=e.ClampCompliance(3e13, 3e13),
    clamp_friction=e.ClampFriction(0.1),
    added_mass=e.AddedMass(0.003, 0.27, 0.06),
    air_added_mass=e.AirAddedMass(1.2),
    base_rocking=e.BaseRocking(0.1),
    fixture_resonance=e.FixtureResonance(130.0, 0.02, 0.05),
)


def integrated(plate, pieces, times):
    """The same chain by Runge-Kutta, its equations written out anew. Columns as OUTPUTS."""
    s, shaker, fixture = plate.structure, plate.shaker, plate.effects.fixture_resonance
    rocking = plate.effects.base_rocking.pitch_rad_m
    n, k = len(s.M), len(shaker.sections)
    w = np.array([c.omega for c in shaker.sections])
    zeta = np.array([c.damping_ratio for c in shaker.sections])
    gain = np.array([c.gain_m_s2_v for c in shaker.sections])
    # Matrices are applied to all elements of a branch at once: the sum is the same, and far quicker.
    count = [len(b.law.tau_s) for b in s.branches]
    of_branch = np.cumsum([0, *count])
    tau = np.concatenate([b.law.tau_s for b in s.branches])[:, None]
    solve = np.linalg.inv(s.M)
    relaxed = s.K + sum(b.law.g_inf_pa * b.K for b in s.branches)
    w0 = 2 * np.pi * fixture.frequency_hz

    def volts(t):
        piece = pieces[1] if t >= pieces[1].begin_s else pieces[0]
        phase, amplitude = piece.phase_at(t), piece.amplitude_at(t)
        return amplitude * (np.sin(phase) + 0.002 * np.sin(2 * phase) + 0.001 * np.sin(3 * phase))

    def parts(x):
        q, v, z = x[:n], x[n : 2 * n], x[2 * n : (2 + len(tau)) * n].reshape(-1, n)
        base = x[(2 + len(tau)) * n :]
        return q, v, z, base[:k], base[k : 2 * k], base[2 * k :]

    def rate(t, x):
        q, v, z, d, dd, (theta, spin) = parts(x)
        accelerations = gain * volts(t) - 2 * zeta * w * dd - w**2 * d
        turning = fixture.gain_rad_m * w0**2 * d.sum() - 2 * fixture.damping_ratio * w0 * spin - w0**2 * theta
        a = accelerations.sum()
        force = s.loads @ [a, rocking * a + turning] - relaxed @ q - s.C @ v
        for b, first, end in zip(s.branches, of_branch, of_branch[1:], strict=False):
            force -= b.K @ (b.law.g_pa @ z[first:end])
        inner = (v - z / tau).ravel()
        return np.concatenate([v, solve @ force, inner, dd, accelerations, [spin, turning]])

    size = (2 + len(tau)) * n + 2 * k + 2
    out, x, begin = [], np.zeros(size), 0.0
    for end, pick in (
        (pieces[1].begin_s, times < pieces[1].begin_s),
        (times[-1], times >= pieces[1].begin_s),
    ):
        asked = np.append(times[pick], end)
        found = solve_ivp(rate, (begin, end), x, "DOP853", t_eval=np.unique(asked), rtol=1e-9, atol=1e-13)
        columns = found.y[:, : pick.sum()]
        out += [
            (
                rate(t, y)[-2 - k : -2].sum(),
                p[4].sum(),
                p[3].sum(),
                s.readings[0] @ p[1] + p[4].sum() + plate.plate.spot_x_m * (rocking * p[4].sum() + p[5][1]),
                s.readings[1] @ p[0],
            )
            for t, y in zip(times[pick], columns.T, strict=True)
            for p in [parts(y)]
        ]
        x, begin = found.y[:, -1], end
    return np.array(out).T


@one_thread
def test_agrees_with_an_independent_integration():
    plate = ShakenPlate(ALL_IN_ONE)
    for piece in TWO_PIECES:
        plate.drive(piece)
    times = 0.0005 + 0.0013 * np.arange(50)
    exact = plate.at(times[0], 0.0013, len(times))
    other = integrated(plate, TWO_PIECES, times)
    scale = np.abs(other).max(axis=1, keepdims=True)
    assert np.abs((exact - other) / scale).max() < 2e-7


@pytest.mark.parametrize("frequency_hz", [19.3, 100.5, 281.1])
def test_settles_to_the_steady_state(frequency_hz):
    plate = ShakenPlate(shaker=ShakerChain(second_harmonic=0.0, third_harmonic=0.0))
    plate.drive(DrivePiece(0.0, frequency_hz, 0.7, 0.0, 0.4))
    first, step, count = 9.0, 1e-4, 400
    found = plate.at(first, step, count)
    drive = 0.7 * np.exp(1j * (0.4 - np.pi / 2))
    turns = np.exp(2j * np.pi * frequency_hz * (first + step * np.arange(count)))
    for y, name in zip(found, OUTPUTS, strict=True):
        phasor = plate.steady_state(frequency_hz)[name] * drive
        np.testing.assert_allclose(y, (phasor * turns).real, atol=1e-9 * abs(phasor))


def test_steady_state_is_the_plate_s_own_response():
    plate = ShakenPlate()
    for frequency_hz in (14.0, 100.5, 310.0):
        omega = 2 * np.pi * frequency_hz
        s = plate.steady_state(frequency_hz)
        relative = (
            1j * omega * plate.plate.structure.readings[0] @ plate.plate.structure.response(omega)[:, 0]
        )
        assert (s["spot_velocity"] - s["base_velocity"]) / s["base_acceleration"] == pytest.approx(
            relative, rel=3e-5
        )
        assert s["base_acceleration"] == pytest.approx(plate.shaker.acceleration(omega), rel=1e-9)
        assert s["base_velocity"] == pytest.approx(s["base_acceleration"] / (1j * omega), rel=1e-9)
        assert s["base_displacement"] == pytest.approx(-s["base_acceleration"] / omega**2, rel=1e-9)


def test_displacement_and_velocity_go_on_across_pieces():
    plate = ShakenPlate()
    plate.drive(DrivePiece(0.0, 60.0, 1.0, 0.0, 0.0))
    edge = 0.1234567891
    before = plate._motion.state(edge)
    plate.drive(DrivePiece(edge, 200.0, 0.1, 5.0, 1.0))
    scale = np.abs(before).max()
    np.testing.assert_allclose(plate._motion.state(edge), before, atol=1e-9 * scale)
    near = plate.at(edge - 1e-7, 1e-7, 3, ("spot_velocity", "tip_displacement"))
    assert np.abs(np.diff(near, 2)).max() < 1e-5 * np.abs(near).max()


def test_samples_do_not_depend_on_the_pieces_asked_for():
    whole, parts = ShakenPlate(ALL_IN_ONE), ShakenPlate(ALL_IN_ONE)
    for plate in (whole, parts):
        plate.drive(TWO_PIECES[0])
        plate.drive(TWO_PIECES[1])
    step = 1 / 51200
    together = whole.at(0.0, step, 6000)
    apart = np.hstack([parts.at(step * k, step, min(777, 6000 - k)) for k in range(0, 6000, 777)])
    np.testing.assert_allclose(apart, together, atol=1e-10 * np.abs(together).max())


def test_two_columns_on_skewed_times_are_the_same_motion():
    plate = ShakenPlate()
    plate.drive(TWO_PIECES[0])
    fine, late = plate.at(0.0, 1e-5, 2000), plate.at(0.0033, 1e-4, 100)
    np.testing.assert_allclose(late, fine[:, 330:1330:10], atol=1e-10 * np.abs(fine).max())


def test_memory_and_order_are_kept():
    plate = ShakenPlate(memory_s=0.1)
    for k in range(5):
        plate.drive(DrivePiece(0.5 * k, 50.0, 1.0, 0.0, 0.0))
        plate.at(0.5 * k, 1e-3, 450)
    plate.drive(DrivePiece(2.46, 80.0, 1.0, 0.0, 0.0))
    assert plate.at(2.41, 1e-3, 100).all()
    with pytest.raises(ValueError, match="where the memory"):
        plate.at(0.2, 1e-3, 10)
    with pytest.raises(ValueError, match="before the last"):
        plate.drive(DrivePiece(1.0, 50.0, 1.0, 0.0, 0.0))


def test_harmonics_of_the_drive_are_heard():
    plate = ShakenPlate(shaker=ShakerChain(second_harmonic=0.01, third_harmonic=0.0))
    plate.drive(DrivePiece(0.0, 40.0, 1.0, 0.0, 0.0))
    y = plate.at(8.0, 1 / 8000, 8000, ("base_acceleration",))[0]
    lines = np.abs(np.fft.rfft(y)) / 4000
    assert lines[80] == pytest.approx(0.01 * abs(plate.shaker.acceleration(2 * np.pi * 80)), rel=1e-6)
    assert lines[120] < 1e-9


def test_shaker_gain_varies_by_some_twenty_decibels():
    gains = [abs(ShakerChain().acceleration(2 * np.pi * f)) for f in np.geomspace(14, 310, 300)]
    assert 17 < 20 * np.log10(max(gains) / min(gains)) < 23
    assert ShakerChain((ShakerMode(10.0, 0.1, 5.0),)).acceleration(1e6) == pytest.approx(5.0, rel=1e-3)


def test_drift_moves_the_law_and_not_the_state():
    drift = e.TemperatureDrift(2.0, time_constant_s=1.0)
    plate = ShakenPlate(e.Effects(temperature_drift=drift), memory_s=100.0)
    cold, start = plate.law, plate.steady_state(19.3)["spot_velocity"]
    plate.drive(DrivePiece(0.0, 19.3, 1.0, 0.0, 0.0))
    y = plate.at(0.0, 1e-3, 1000, ("spot_velocity", "tip_displacement"))
    changes = [s.begin_s for s in plate._motion._stretches[2:]]
    assert len(changes) > 8
    for before, after in zip(plate._motion._stretches[1:], plate._motion._stretches[2:], strict=False):
        x = before.state(after.begin_s)
        np.testing.assert_allclose(after.state(after.begin_s), x, atol=1e-9 * np.abs(x).max())
    factor = 10 ** (-drift.c1 * 2.0 * -np.expm1(-1.0) / (drift.c2_kelvin + 2.0 * -np.expm1(-1.0)))
    wanted = cold.shifted(factor).modulus(2 * np.pi * 60.0)
    assert plate.law.modulus(2 * np.pi * 60.0) == pytest.approx(wanted, rel=5e-3)
    assert abs(plate.steady_state(19.3)["spot_velocity"] / start - 1) > 0.005
    assert np.isfinite(y).all()


def test_softening_comes_to_its_fixed_point():
    soft = e.AmplitudeSoftening(0.15, reference_strain=0.07, time_constant_s=0.1)
    plate = ShakenPlate(e.Effects(amplitude_softening=soft))
    stiff = plate.law.modulus(100.0)
    volts = 9.81 / abs(plate.steady_state(19.3)["base_acceleration"])
    plate.drive(DrivePiece(0.0, 19.3, volts, 0.0, 0.0))
    plate.at(0.9, 1e-3, 10)
    factor = 1 - 0.15 * plate.core_strain(19.3, volts) / 0.07
    assert 0.8 < factor < 0.9
    assert abs(plate.law.modulus(100.0) / stiff) == pytest.approx(factor, abs=1e-3)


@pytest.mark.timing
def test_samples_per_second():
    import time

    plate = ShakenPlate()
    plate.drive(DrivePiece(0.0, 30.0, 1.0, 0.0, 0.0))
    plate.at(0.0, 1e-5, 10, ("spot_velocity",))
    rates = []
    for first in (0.001, 20.0):
        begun = time.perf_counter()
        plate.at(first, 1e-5, 200_000, ("spot_velocity",))
        rates.append(200_000 / (time.perf_counter() - begun))
    assert rates[0] > 0.5e6
    assert rates[1] > 2e6
