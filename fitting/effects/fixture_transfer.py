"""Between base accelerometer and pads stands a fixture: alike for every mass, whatever the mass is."""

from collections.abc import Mapping

from fitting.effects.base import Effect
from fitting.effects.given import Points
from fitting.widened.enriched_plate import EnrichedReducedPlate


class FixtureTransferEffect(Effect):
    """Seen in what several masses have in common; no unknown is fitted.

    See `fitting.diagnosis.verdict.rig_transfer`.
    """

    name = "fixture_transfer"
    enters = "channel"
    source = "a common complex factor over frequency, by its marginal likelihood"
    structures = frozenset({"shear-pair"})
    discriminating_test = "the base accelerometer moved to the pads' own face; or both on one rigid block"

    def objection(self, points: Points, plate: EnrichedReducedPlate) -> str | None:
        return "it shows where several masses lack the same and nothing else explains it"

    def story(self, u: Mapping[str, float]) -> str:
        return (
            f"all files are off alike by {100 * u['size']:.2g} % (gain {100 * u['gain']:+.1f} % and phase "
            f"{57.3 * u['phase']:+.1f} degrees on the average, up to {100 * u['largest']:.2g} % at one "
            f"frequency), as of a fixture between base accelerometer and pads; each by itself by "
            f"{100 * u['own']:.2g} % more, which nothing explains"
        )
