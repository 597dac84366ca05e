"""What a command, an engine or a window loads before it does anything: it answers as soon as that is done."""

import subprocess
import sys

LOOK = """
import sys
from importlib import import_module

def loaded(*names):
    return [name for name in names if name in sys.modules]

for command in ("identify", "diagnose", "predict", "plan", "check"):
    import_module(f"instrument.cli.{command}")
print(loaded("matplotlib", "pymodbus", "httpx", "drivers.simulated.rig", "instrument.run.experiment"))
import gui.frame.window, instrument.engine.process
print(loaded("matplotlib", "drivers.simulated.rig", "scipy.stats"))
"""


def test_no_figure_no_rig_and_none_of_scipys_distributions_is_loaded_until_it_is_asked_for():
    looked = subprocess.run([sys.executable, "-c", LOOK], capture_output=True, text=True, check=True)
    assert looked.stdout.split("\n")[:2] == ["[]", "[]"]
