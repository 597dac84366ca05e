"""A thousand sessions in a batch: throughput, scaling, memory, a kill at a third, a cluster.

    python tests/by_hand/batch.py [--count 1000] [--folder out/batch-campaign] [--sweeps [--tolerances]]

Prints a table. Sessions, or sweeps, have 9 to 400 points; one is cut off. Models are made before time is
taken.
"""

import json
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path
from time import perf_counter

import click

sys.path.insert(0, str(Path(__file__).parents[1] / "helpers"))
from batch_cases import write_sessions, write_specimen, write_sweeps

from instrument.progress import LINES

POINTS = (9, 25, 100, 400)


@click.command()
@click.option("--count", default=1000)
@click.option("--folder", type=click.Path(path_type=Path), default=Path("out/batch-campaign"))
@click.option("--sweeps", "tables", is_flag=True, help="CSV files instead of sessions (these take 1.2 GB).")
@click.option("--tolerances", is_flag=True, help="Stated numbers of the sweeps may move: a longer fit.")
def main(count: int, folder: Path, tables: bool, tolerances: bool) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    os.environ["VISCORIG_CACHE"] = str(folder / "cache")
    plate = write_specimen(folder, exact=not tolerances) if tables else None
    sweeps = write_sweeps(folder, plate, count, POINTS) if plate else write_sessions(folder, count, POINTS)
    os.truncate(sweeps[count // 2], sweeps[count // 2].stat().st_size // 2)
    few = [str(s) for s in sweeps[: 2 * len(POINTS)]]
    one_go("models made", few, plate, folder / "warm", ["--workers", "1"])
    rates = {
        n: one_go(f"{n} workers", sweeps, plate, folder / f"w{n}", ["--workers", str(n)]) for n in (1, 2)
    }
    print(f"scaling 1 to 2: {rates[2] / rates[1]:.2f}")
    killed(sweeps, plate, folder / "killed", count)
    same(folder, "w1", "w2", "killed")
    rates = {n: clustered(sweeps, plate, folder / f"dask{n}", n) for n in (1, 2)}
    print(f"scaling 1 to 2 Dask workers: {rates[2] / rates[1]:.2f}")
    same(folder, "w1", "dask1", "dask2")


def command(sweeps, plate, out, options):
    table = out.with_suffix(".rows.csv")
    table.write_text("\n".join(["data", *(str(Path(s).absolute()) for s in sweeps), ""]), encoding="utf-8")
    words = [sys.executable, "-m", "instrument.cli", "batch", str(table)]
    own = ["--specimen", str(plate.absolute())] if plate else []
    return [*words, *own, "--out", str(out), *options]


def one_go(name, sweeps, plate, out, options):
    began, before = perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command(sweeps, plate, out, options), check=True, stdout=subprocess.DEVNULL)
    seconds, after = perf_counter() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(
        f"{name}: {len(sweeps)} rows in {seconds:.1f} s, {len(sweeps) / seconds:.1f} rows/s, "
        f"{len(sweeps) / busy:.1f} rows per second of a core; largest process so far "
        f"{after.ru_maxrss / 1024:.0f} MB",
        flush=True,
    )
    return len(sweeps) / seconds


def killed(sweeps, plate, out, count):
    words = command(sweeps, plate, out, ["--workers", "2"])
    environment = {**os.environ, LINES: "lines"}
    with subprocess.Popen(words, stderr=subprocess.PIPE, text=True, env=environment) as first:
        for line in first.stderr:
            told = json.loads(line)
            if told["work"] == f"{count} rows" and told["fraction"] >= 1 / 3:
                os.kill(first.pid, signal.SIGKILL)
                break
        first.stderr.read()
    before = keys(out)
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL)
    after = keys(out)
    print(f"killed with {len(before)} rows done; then {len(after)}, repeated {len(after) - len(set(after))}")


def keys(out):
    text = (out / "batch.jsonl").read_text(encoding="utf-8")
    return [json.loads(line)["key"] for line in text.splitlines(keepends=True) if line.endswith("\n")]


def same(folder, first, *others):
    one = (folder / first / "batch.csv").read_bytes()
    for other in others:
        print(
            f"table of {other} equal to that of {first}: {(folder / other / 'batch.csv').read_bytes() == one}"
        )


def clustered(sweeps, plate, out, count):
    dask = [sys.executable, "-m", "dask"]
    scheduler = subprocess.Popen(
        [*dask, "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard"],
        stderr=subprocess.PIPE,
        text=True,
    )
    address = next(line.split()[-1] for line in scheduler.stderr if "Scheduler at:" in line)
    worker = [*dask, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
    workers = [subprocess.Popen(worker, stderr=subprocess.DEVNULL) for _ in range(count)]
    rate = one_go(f"{count} Dask workers", sweeps, plate, out, ["--scheduler", address])
    for process in (*workers, scheduler):
        process.terminate()
        process.wait()
    return rate


if __name__ == "__main__":
    main()
