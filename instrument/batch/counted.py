"""What a batch came to, in a few numbers."""

from collections import Counter
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from instrument.batch.between import Between
from instrument.batch.columns import NOT_DIAGNOSED, is_doubted
from instrument.batch.run import BatchRow
from instrument.facts.batch import BatchFailure, BatchRepeat, BatchResult


@dataclass
class Counted:
    """Rows by what came of them."""

    rows: int = 0
    done: int = 0
    verdicts: Counter[str] = field(default_factory=Counter)
    effects: Counter[str] = field(default_factory=Counter)
    failures: list[tuple[str, str]] = field(default_factory=list)
    """Data and reason, in the order of the rows."""
    doubted: list[str] = field(default_factory=list)
    """Data whose law says of itself that it may be biased."""
    borrowed: int = 0
    """Rows worked out on another specimen's reduced model."""

    @classmethod
    def of(cls, rows: Iterable[BatchRow]) -> "Counted":
        """In one pass."""
        found = cls()
        for row in rows:
            o = row.outcome
            found.rows += 1
            if o["failed"]:
                found.failures.append((row.task.data, o["failed"]))
                continue
            found.done += 1
            if is_doubted(row):
                found.doubted.append(row.task.data)
            found.borrowed += bool(o["borrowed_model"])
            found.verdicts[o["verdict"] or NOT_DIAGNOSED] += 1
            found.effects.update(o["effects"])
        return found

    def result(
        self,
        known_before: int,
        files: Iterable[Path],
        spread: Iterable[Between] = (),
        repeats: Sequence[tuple[str, str]] = (),
    ) -> BatchResult:
        """As JSON has it; `repeats` are data and the earlier row's."""
        return BatchResult(
            rows=self.rows,
            done=self.done,
            failed=len(self.failures),
            verdicts=dict(self.verdicts),
            effects=dict(self.effects.most_common()),
            borrowed_models=self.borrowed,
            failures=tuple(BatchFailure(data=data, reason=why) for data, why in self.failures),
            doubted=tuple(self.doubted),
            repeats=tuple(BatchRepeat(data=data, repeats=first) for data, first in repeats),
            known_before=known_before,
            spread=tuple(one.result for one in spread),
            files=tuple(str(path) for path in files),
        )
