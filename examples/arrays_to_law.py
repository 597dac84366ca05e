"""From measured arrays to the core's law: nine amplitudes of the published plate, at 1 g."""

# %%
import numpy as np

import viscorig as vr

specimen = vr.load_specimen(vr.example_file("zn1.toml"))
frequency_hz = np.array([18.4, 19.3, 20.2, 94.3, 100.5, 105.0, 264.8, 281.1, 295.2])
velocity_m_s = np.array([0.0726, 0.1112, 0.0705, 0.0197, 0.0279, 0.0240, 0.0082, 0.0107, 0.0092])
sweep = vr.Sweep(frequency_hz, velocity_m_s, commanded_m_s2=9.81)
found = vr.identify(sweep, specimen)
ax = found.plot()
