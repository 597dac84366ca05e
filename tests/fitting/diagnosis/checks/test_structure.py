import numpy as np

from fitting.data.readings import Readings
from fitting.diagnosis.checks.structure import along_frequency, roughness, structure
from fitting.diagnosis.inference.evidence import Evidence
from fitting.diagnosis.thresholds import VERDICT
from fitting.numerics.chances import normal_exceeded
from fitting.sweep import Sweep

N = 118


def sweep(segments=3):
    count = N * segments
    ones = np.ones(count)
    return Sweep(
        frequency_hz=np.linspace(14, 300, count),
        velocity_m_s=ones + 0j,
        commanded_m_s2=9.81 * ones,
        segment=np.repeat(np.arange(1, segments + 1), N),
        sweep=np.ones(count, dtype=int),
    )


def evidence(data):
    ones = np.ones(len(data))
    B = np.array([np.tile(data.segment == k, 2) * ones[0] for k in (1, 2, 3)]).T
    return Evidence(Readings(data.velocity_m_s), ones, ones, B, True)


def bending(data, times):
    """Evidence whose plate may be off in each segment, and residuals of one that is, so many times more."""
    B = np.array([np.tile(data.segment == k, 2) * 0.3 for k in (1, 2, 3)]).T
    known = Evidence(Readings(data.velocity_m_s), np.ones(len(data)), np.ones(len(data)), B, True)
    rng = np.random.default_rng(2)
    return known, known.whitening(rng.normal(size=2 * len(data)) + times * B @ np.array([1.0, -1.0, 1.0]))


def test_a_plate_that_is_off_by_more_than_it_may_be_is_structure():
    data = sweep()
    for times, told in ((1.0, False), (5.0, True)):
        known, r = bending(data, times)
        said = structure(data, known, r, float(r @ r / len(r)))
        assert any("layer-wise" in one for one in said) == told


def test_a_beam_is_not_called_a_plate():
    data = sweep()
    known, r = bending(data, 5.0)
    (said,) = [one for one in structure(data, known, r, 1.0, "shear-pair") if "off by" in one]
    assert said.startswith("the shear pair would have to be off by")
    assert said.endswith("times what its theory is")


def test_white_residuals_are_rarely_taken_for_structure():
    data, alarms = sweep(), 0
    for seed in range(300):
        r = np.random.default_rng(seed).normal(size=2 * len(data))
        alarms += bool(structure(data, evidence(data), r, float(r @ r / len(r))))
    assert alarms <= 1


def test_a_slow_wave_as_large_as_the_noise_is_structure():
    data = sweep()
    wave = np.sin(2 * np.pi * np.arange(2 * len(data)) / 40)
    r = np.random.default_rng(0).normal(size=2 * len(data)) + wave
    said = " ".join(structure(data, evidence(data), r, float(r @ r / len(r))))
    assert "runs" in said
    assert "Ljung-Box" in said


def one_piece(count):
    ones = np.ones(count)
    number = ones.astype(int)
    return Sweep(np.linspace(14, 600, count), ones + 0j, 9.81 * ones, segment=number, sweep=number)


def wandering(count, share):
    """White residuals, a share of whose variance goes on for some twenty readings."""
    rng, keep = np.random.default_rng(1), np.exp(-1 / 20)
    white, kicks = rng.normal(size=(2, 2 * count))
    walk = np.zeros(2 * count)
    for k in range(1, 2 * count):
        walk[k] = keep * walk[k - 1] + np.sqrt(1 - keep**2) * kicks[k]
    return np.sqrt(1 - share) * white + np.sqrt(share) * walk


def test_a_long_trace_counts_as_a_hundred_or_two():
    """A tenth of the noise that goes on is nothing to refuse for, however many readings; all of it is."""
    data = one_piece(1200)
    counted, plain = (
        along_frequency(data, wandering(1200, 0.1), 2, n) for n in (VERDICT.longest_trace, None)
    )
    assert plain[1] > 8.0
    assert counted[1] < 4.0
    refused = VERDICT.wider_along * normal_exceeded(VERDICT.check_level)
    assert all(z > refused for z in along_frequency(data, wandering(1200, 0.6), 2, VERDICT.longest_trace))
    short = one_piece(120)
    r = wandering(120, 0.3)
    assert along_frequency(short, r, 2, VERDICT.longest_trace) == along_frequency(short, r, 2)


def test_nothing_is_said_where_the_noise_is_unknown():
    data = sweep()
    unknown = Evidence(
        Readings(data.velocity_m_s),
        np.ones(len(data)),
        np.ones(len(data)),
        np.zeros((2 * len(data), 1)),
        False,
    )
    assert structure(data, unknown, np.full(2 * len(data), 9.0), 81.0) == ()


def test_what_jumps_from_point_to_point_is_noise_whatever_is_missed_smoothly():
    data = sweep()
    noise = 0.7 * np.random.default_rng(1).normal(size=2 * len(data))
    wave = 5 * np.sin(2 * np.pi * np.arange(2 * len(data)) / 60)
    for left in (noise, noise + wave):
        assert abs(roughness(data, left, parts=2) / 0.49 - 1) < 0.2


def test_what_blows_scatter_by_alike_at_neighbouring_lines_is_no_structure_below_their_noise():
    data = sweep(1)
    rng, struck = np.random.default_rng(4), np.ones(N, bool)
    slow = np.tile(np.sin(np.linspace(0, 20, N)), 2)
    for size, told in ((0.2, False), (1.5, True)):
        r = size * slow + 0.05 * rng.normal(size=2 * N)
        assert min(along_frequency(data, r, 2)) > 6
        runs, memory = along_frequency(data, r, 2, struck=struck)
        assert (runs > VERDICT.runs_sigma) == told
        assert (memory > VERDICT.memory_sigma) == told
        assert along_frequency(data, r, 2, struck=~struck) == along_frequency(data, r, 2)


def test_white_noise_of_blows_has_as_little_structure_as_any():
    data, found = sweep(1), []
    for seed in range(200):
        r = 0.7 * np.random.default_rng(seed).normal(size=2 * N)
        found.append(along_frequency(data, r, 2, struck=np.ones(N, bool)))
    assert np.abs(np.mean(found, axis=0)).max() < 0.2
    assert np.std(found, axis=0).max() < 1.0
