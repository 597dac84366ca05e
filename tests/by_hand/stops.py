"""Stops at random moments of runs: python tests/by_hand/stops.py --stops 50 --seed 1 [--frozen]

Of each: how long the shaker took to zero after the call, and whether it was driven again before the engine's
end. A longer form of tests/instrument/engine/test_stop.py; exit status 1 where a stop took over half a second
or did not last.
"""

import argparse
import os
import random
import signal
import sys
import tempfile
import threading
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from engine_cases import LONG, drive_v, ended, engine_of, engine_rig, follow, wait_until

from instrument.engine import Order

WITHIN_S = 0.5


def stop_once(folder: Path, after_s: float, *, frozen: bool) -> tuple[float, bool, str]:
    """Seconds to silence, whether it was driven again, why the run ended."""
    with engine_rig(folder, sweep=LONG) as (rig, experiment), engine_of(Order(experiment, folder)) as engine:
        wait_until(lambda: any(e.what == "started" for e in rig.device.log))
        time.sleep(after_s)
        if frozen:
            os.kill(engine.pid, signal.SIGSTOP)
        thread = threading.Thread(target=engine.stop)
        began = time.monotonic()
        thread.start()
        wait_until(lambda: drive_v(rig) == 0 and _was_stopped(rig), 10)
        took = time.monotonic() - began
        thread.join()
        if frozen:
            os.kill(engine.pid, signal.SIGCONT)
        again = False

        def look(_: object = None) -> None:
            nonlocal again
            again = again or drive_v(rig) > 0

        end = ended(follow(engine, look))
        look()
        return took, again, end.why


def _was_stopped(rig) -> bool:
    return any(e.what == "stopped" for e in rig.device.log)


def main() -> int:
    """The worst of them, and how many failed."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stops", type=int, default=50)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--frozen", action="store_true", help="freeze the engine before, wake it up after")
    options = parser.parse_args()
    chance = random.Random(options.seed)
    worst, failed = 0.0, 0
    for number in range(options.stops):
        with tempfile.TemporaryDirectory() as folder:
            took, again, why = stop_once(Path(folder), chance.uniform(0.0, 1.5), frozen=options.frozen)
        worst = max(worst, took)
        failed += took > WITHIN_S or again
        print(f"{number + 1}: silent after {took:.3f} s, driven again: {again}, {why}", flush=True)
    print(f"worst {worst:.3f} s, {failed} of {options.stops} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
