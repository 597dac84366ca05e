"""A campaign: many cases diagnosed in processes, every outcome kept as a line, so that it can go on later."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from instrument.errors import BadInput, StoppedByUser
from instrument.files.text import read_text
from instrument.processes.jobs import in_processes
from instrument.progress import Progress, quiet

OUTCOMES, BEGUN, SUMMARY = "outcomes.jsonl", "campaign.json", "summary.md"
_SOURCES = (
    "fitting",
    "drivers/simulated/plant",
    "campaign",
    "instrument/models",
    "instrument/processes",
    "instrument/remarks",
    "instrument/mistakes",
    "instrument/finding",
    "instrument/temperatures",
)
"""What an outcome depends on: a folder goes on only with the program that began it."""


@dataclass(frozen=True)
class Job:
    """One case to draw and to diagnose."""

    kind: str
    seed: int


Judge = Callable[[Job], dict[str, Any]]
"""From a job to its line, which repeats `kind` and `seed`."""


def in_rotation(kinds: Sequence[str], count: int, seed: int) -> list[Job]:
    """One kind after the other, round and round; seeds from `seed` on."""
    return [Job(kinds[k % len(kinds)], seed + k) for k in range(count)]


def run_campaign(
    jobs: Sequence[Job],
    folder: Path,
    judged_by: Judge,
    options: Mapping[str, Any],
    *,
    workers: int = 2,
    progress: Progress = quiet,
) -> list[dict[str, Any]]:
    """Lines of all jobs, with those an earlier run left in `folder`. Raises `BadInput`, `StoppedByUser`.

    `options` are those of `judged_by`, by which outcomes differ.
    """
    _same_program(folder, {**options, "sources": fingerprint()})
    known = {(line["kind"], line["seed"]): line for line in read_lines(folder) if not line.get("error")}
    left = [job for job in jobs if (job.kind, job.seed) not in known]
    done = len(jobs) - len(left)
    with progress(f"{len(jobs)} cases") as report, open(folder / OUTCOMES, "a", encoding="utf-8") as file:

        def keep(job: Job, line: dict[str, Any]) -> None:
            nonlocal done
            file.write(json.dumps(line) + "\n")
            file.flush()
            known[line["kind"], line["seed"]] = line
            done += 1
            report(done / len(jobs))

        try:
            in_processes(judged_by, left, workers, keep)
        except KeyboardInterrupt:
            said = f"{done} of {len(jobs)} cases done, kept in {folder}; the same command goes on"
            raise StoppedByUser(said) from None
    return [known[job.kind, job.seed] for job in jobs]


def why_not(raised: Exception) -> str:
    """What a case without an answer keeps of it, in a line."""
    return " ".join(f"{type(raised).__name__}: {raised}".split())


def keep_summary(text: str, folder: Path) -> str:
    """Keep a summary in the folder, and give its text back."""
    (folder / SUMMARY).write_text(text, encoding="utf-8")
    return text


def read_lines(folder: Path) -> list[dict[str, Any]]:
    """What is there; a line torn by a kill is dropped, from the file too.

    Raises `BadInput` for what is not JSON.
    """
    path = folder / OUTCOMES
    if not path.exists() or not path.stat().st_size:
        # One that was stopped before its first case.
        return []
    text = read_text(path)
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        path.write_text(whole, encoding="utf-8")
    try:
        return [json.loads(line) for line in whole.splitlines()]
    except json.JSONDecodeError as error:
        raise BadInput(f"{path}: not a line of JSON: {error.msg}, expected what a campaign wrote") from None


def fingerprint() -> str:
    """A digest of the sources that decide an outcome."""
    root = Path(__file__).parents[1]
    digest = hashlib.sha256()
    for name in _SOURCES:
        for file in sorted([*root.glob(f"{name}.py"), *(root / name).rglob("*.py")]):
            digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


def _same_program(folder: Path, facts: dict[str, Any]) -> None:
    """Outcomes of two programs are never mixed in a folder."""
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / BEGUN
    if not path.exists():
        path.write_text(json.dumps(facts) + "\n", encoding="utf-8")
    elif json.loads(read_text(path)) != facts:
        raise BadInput(f"{folder}: a campaign begun with other sources or options, expected a new folder")
