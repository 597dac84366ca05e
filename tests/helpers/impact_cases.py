"""Synthetic impact tests with known poles, made in the frequency domain of a long record."""

import numpy as np

from instrument.impact.record import Hit, ResponseChannel

TABLE_3 = np.array([0.29, 0.13, 0.18, 0.21, 0.11, 0.07, 0.09, 0.04]) / 100
BARE_HZ = np.array([17.714, 59.845, 110.122, 201.879, 275.142, 316.218, 411.675, 438.027])
"""The bare plate's natural frequencies."""
AMPLITUDES = np.array([1.0, -0.9, 0.8, 1.1, -0.7, 0.9, 0.8, -1.0])
RATE, SECONDS = 2048.0, 8.0
MOTION = {"displacement": 0, "velocity": 1, "acceleration": 2}


def clean_hit(
    f=BARE_HZ, zeta=TABLE_3, amplitudes=AMPLITUDES, *, seconds=SECONDS, rate=RATE, motion="acceleration"
):
    """Force and response: a half sine of 1 ms after a pre-trigger of 20 ms."""
    n, fine, long = int(seconds * rate), 8, 4
    pulse = 100 * np.sin(np.pi * np.arange(0, 1e-3, 1 / rate / fine) / 1e-3)
    force = np.zeros(n * fine * long)
    start = int(0.02 * rate * fine)
    force[start : start + len(pulse)] = pulse
    w = 2 * np.pi * np.fft.rfftfreq(len(force), 1 / rate / fine)
    H = np.zeros(len(w), dtype=complex)
    for f_r, z, a in zip(f, zeta, amplitudes, strict=True):
        w_r = 2 * np.pi * f_r
        H += a * (1j * w) ** MOTION[motion] / (w_r**2 - w**2 + 2j * z * w_r * w)
    response = np.fft.irfft(np.fft.rfft(force) * H, len(force))
    return force[: n * fine : fine], response[: n * fine : fine]


def hit_of(force, response, source="hit", motion="acceleration", rate=RATE):
    return Hit(source, rate, force, (ResponseChannel("acceleration_m_s2", motion, response),))


def noisy_hits(clean, rng, count=3, noise=0.002):
    """`noise` of each channel's peak on every sample."""
    force, response = clean
    return [
        hit_of(
            force + noise * np.abs(force).max() * rng.normal(size=len(force)),
            response + noise * np.abs(response).max() * rng.normal(size=len(force)),
            f"hit {k + 1}",
        )
        for k in range(count)
    ]
