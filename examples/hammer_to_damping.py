"""From hammer blows on the bare plate to damping ratios, and from there into an identification."""

# %% Three blows as they could come from any data acquisition: arrays of force and acceleration
import numpy as np

import viscorig as vr

specimen = vr.load_specimen(vr.example_file("zn1.toml"))
layers = {name: table for name, table in specimen.as_dict().items() if name not in ("core", "constraining")}
modes = vr.modes(vr.Specimen(**layers), count=6)
ratio, rate_hz = np.array([0.29, 0.13, 0.18, 0.21, 0.11, 0.07]) / 100, 2048.0
time_s = np.arange(16384) / rate_hz
omega = 2 * np.pi * modes.frequency_hz[:, None]
ringing = np.sum(np.exp(-ratio[:, None] * omega * time_s) * np.sin(omega * time_s), axis=0)
force_n = np.zeros(len(time_s))
force_n[40:43] = 50.0, 100.0, 50.0
response = np.convolve(force_n, ringing)[: len(time_s)]
rng = np.random.default_rng(1)
hits = [
    vr.Hit(
        force_n + 0.05 * rng.normal(size=len(time_s)),
        rate_hz,
        acceleration_m_s2=response + 0.1 * rng.normal(size=len(time_s)),
        name=f"hit {k}",
    )
    for k in (1, 2, 3)
]

# %% Natural frequencies and ratios, three methods side by side
found = vr.damping(hits, band_hz=(10.0, 400.0))
print(found.to_dataframe()[["frequency_hz", "damping_ratio", "lscf_ratio", "half_power_ratio"]])
ax = found.plot()

# %% The bare plate's test takes part in the core's identification
sweep = vr.load_sweep(vr.example_file("table5.csv"), specimen)
print(vr.identify(sweep, specimen, hammer=found))
