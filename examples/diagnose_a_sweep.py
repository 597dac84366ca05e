"""A sweep that the model cannot follow, and why: the laser's spot is 4 mm from where it is said to be."""

# %% The plate as it is described, and a sweep of it as it is
import numpy as np

import viscorig as vr

described = vr.load_specimen(vr.example_file("specimen.toml")).but(mesh={"elements_x": 10, "elements_y": 10})
real = described.but(pickup={"x_mm": 64.0})
frequency_hz = np.concatenate([np.linspace(a, b, 11) for a, b in ((15, 25), (85, 115), (240, 290))])
velocity_m_s = vr.predict(real, frequency_hz).velocity_m_s
noise = np.random.default_rng(1).normal(size=(2, len(frequency_hz)))
velocity_m_s *= 1 + 2e-3 * (noise[0] + 1j * noise[1])

# %% What its residual shows
sweep = vr.Sweep(frequency_hz, velocity_m_s, std_m_s=2e-3 * np.abs(velocity_m_s))
found = vr.diagnose(sweep, described)
print(found)

# %% The candidates, best first, as pandas
print(found.to_dataframe().head())

# %% The residual and the law, without and with the effect
residual = found.plot()
law = found.plot_law()
