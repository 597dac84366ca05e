"""Every command against spoiled files of every format: anything but its work, or a refusal in one line?

    python tests/by_hand/attack.py --cases 500 --seed 1

Each case is a process of its own, so that memory, hangs and crashes of libraries are seen too.
"""

import argparse
import lzma
import os
import random
import shutil
import signal
import sys
import tempfile
import time
import traceback
from collections import Counter
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))

from attacked_files import COMMANDS, SLOW, write_files
from attacks import faults_of, spoil
from data_folder import DATA

from instrument.cli.main import run

HANGS_S, MOST_MB = 90.0, 1500


def main() -> None:
    asked = _arguments()
    here = Path(tempfile.mkdtemp(prefix="viscorig-attack-"))
    os.environ["VISCORIG_CACHE"], os.environ["VISCORIG_PROCESSES"] = str(here / "cache"), "1"
    valid = here / "valid"
    valid.mkdir()
    session = here / "small.h5"
    session.write_bytes(lzma.decompress((DATA / "numbers" / "small.h5.xz").read_bytes()))
    write_files(valid, session)
    commands = {n: (*c, *(SLOW.get(n, ()) if asked.slow else ())) for n, c in COMMANDS.items()}
    names = [n for n in commands if asked.only in n]
    found: Counter[str] = Counter()
    for case in range(asked.first, asked.first + asked.cases):
        rng = random.Random(f"{asked.seed} {case}")
        name = rng.choice(names)
        line = rng.choice(commands[name])
        if asked.command and not line.startswith(asked.command):
            continue
        folder = here / f"case-{case}"
        shutil.copytree(valid, folder)
        try:
            spoil(folder / name, rng, bytes_of_hdf=True)
        except (ValueError, IndexError, TypeError, OSError, KeyError, NotImplementedError):
            shutil.rmtree(folder)
            continue
        faults, said = one(folder, line.format(name).split())
        found["cases"] += 1
        for fault in faults:
            found[fault.split(",")[0]] += 1
            print(f"case {case}: {line.format(name)}: {fault}: {said[-asked.shown :]}", flush=True)
        if not (faults and asked.keep):
            shutil.rmtree(folder)
    print(dict(found), here if asked.keep else "")
    if not asked.keep:
        shutil.rmtree(here)


def one(folder: Path, arguments: list[str]) -> tuple[list[str], str]:
    """Faults of one command, and what it said on standard error."""
    before = {p.name for p in folder.rglob("*")}
    child = os.fork()
    if child == 0:
        _child(folder, arguments)
    began, status, used = time.monotonic(), None, None
    while status is None:
        done, status, used = os.wait4(child, os.WNOHANG)
        if done == 0:
            status = None
            if time.monotonic() - began > HANGS_S:
                os.kill(child, signal.SIGKILL)
                _, status, used = os.wait4(child, 0)
                return [f"hangs over {HANGS_S:g} s"], ""
            time.sleep(0.005)
    out, err = ((folder.parent / f"{folder.name}.{k}").read_text(errors="replace") for k in ("out", "err"))
    left = sorted({p.name for p in folder.rglob("*")} - before)
    faults = faults_of(
        os.waitstatus_to_exitcode(status), out, err, left, said_at_once=arguments[0] == "check"
    )
    if used.ru_maxrss > 1024 * MOST_MB:
        faults.append(f"{used.ru_maxrss / 1024:.0f} MB of memory")
    for k in ("out", "err"):
        (folder.parent / f"{folder.name}.{k}").unlink()
    return faults, err if err.strip() else out


def _child(folder: Path, arguments: list[str]) -> None:
    status = 70
    try:
        os.chdir(folder)
        for k, name in ((1, "out"), (2, "err")):
            os.dup2(os.open(folder.parent / f"{folder.name}.{name}", os.O_CREAT | os.O_WRONLY), k)
        status = run(arguments)
    except BaseException:
        traceback.print_exc()
    finally:
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cases", type=int, default=300)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--only", default="", help="Files whose name has this in it.")
    parser.add_argument("--command", default="", help="Commands that begin so.")
    parser.add_argument("--slow", action="store_true", help="Also those that take seconds.")
    parser.add_argument("--keep", action="store_true", help="The files of cases with faults.")
    parser.add_argument("--shown", type=int, default=600)
    return parser.parse_args()


if __name__ == "__main__":
    main()
