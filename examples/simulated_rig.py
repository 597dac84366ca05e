"""A hammer test on the simulated rig: the same lines run a real one, with its own RIG.toml."""

# %% Instruments that are simulated, in a process of their own; the plate is a 3D solid
import tempfile

import viscorig as vr

rig = vr.Rig.from_file(vr.example_file("rig.toml"))
folder = tempfile.mkdtemp()

# %% Leave `parts` out for the whole experiment: calibration, sweep, live identification, diagnosis
session = rig.run(vr.example_file("experiment.toml"), out=folder, parts=("hammer",))
print(session)
ax = session.hammer.plot()

# %% What was recorded stays in a file
again = vr.load_session(session.path)
print(again.hammer.to_dataframe())
