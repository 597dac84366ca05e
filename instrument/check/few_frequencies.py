"""A sweep at too few frequencies for the law that is to be found from it."""

from collections.abc import Sequence

from fitting.laws.base import CoreLaw
from instrument.stepped_sine.plan import PlannedSegment


def few_frequencies_remark(law: CoreLaw | None, planned: Sequence[PlannedSegment]) -> str:
    """What a sweep with fewer frequencies than its law has parameters leaves open; empty where that is none.

    `law` is the core's to start from; None of a specimen without a core.
    """
    count = len({f for segment in planned for f in segment.frequencies_hz})
    if law is None or count >= len(law.names):
        return ""
    what = "frequency" if count == 1 else "frequencies"
    return (
        f"{count} {what} for the {len(law.names)} parameters of core law {law.kind}: too few to find "
        "the law or a cause by: measure more"
    )
