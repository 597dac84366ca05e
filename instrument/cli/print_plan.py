"""A plan as tables."""

from fitting.digits import two_digits
from fitting.gravity import PUBLISHED_G_M_S2
from instrument.cli.output import Output
from instrument.facts.plan import EffectForecast, PlanResult, SettlingForecast, SpotCompared
from instrument.files.acceleration import acceleration_unit
from instrument.results.units_shown import size_shown

_MOST_SPOTS = 8
_MOST_RIVALS = 3


def print_plan(out: Output, found: PlanResult) -> None:
    """All of it for a person."""
    _headline(out, found)
    rows = [
        [f"{p.segment}", f"{p.low_hz:g} to {p.high_hz:g}", f"{p.steps}", f"{p.seconds:.0f}"]
        for p in found.segments
    ]
    out.table("steps", ["segment", "f/Hz", "steps", "s"], rows)
    rows = [
        [f"{row.frequency_hz:.4g}", *map(two_digits, (row.storage_modulus_percent, row.loss_factor_percent))]
        for row in found.law[:: max(1, (len(found.law) - 1) // 5)]
    ]
    out.table("predicted standard errors", ["f/Hz", "G'/%", "loss factor/%"], rows)
    _levels(out, found)
    _spots(out, found)
    _effects(out, found)
    for note in found.notes:
        out.say(f"note: {note}")
    out.say("\n" + found.sweep_toml)


def _headline(out: Output, found: PlanResult) -> None:
    out.say(
        f"{len(found.steps)} steps at {_level(found.level_g)} in about {found.seconds:.0f} s leave at most "
        f"{two_digits(found.worst_percent)} % on G' and the loss factor from {found.band_low_hz:g} to "
        f"{found.band_high_hz:g} Hz (predicted to first order)"
    )
    exceeds = next((x.why_not for x in found.levels if x.level_g == found.level_g), "")
    if exceeds:
        out.say(f"this level takes more than 80 % of a usual limit: {exceeds}")
    if not found.reached:
        out.say(
            f"{found.target_percent:g} % is out of reach: everything measured would leave "
            f"{two_digits(found.limit_percent)} %"
        )
        for limit in found.limited_by:
            out.say(f"  {limit.name} known exactly would leave {two_digits(limit.worst_percent)} %")
    if found.settling is not None:
        out.say(_settling(found.settling, len(found.steps)))
    out.say(
        f"assumed: readings scatter by {found.noise_share_percent:g} %, "
        f"{1e6 * found.noise_floor_m_s:g} um/s over one second\n"
    )


def _settling(s: SettlingForecast, steps: int) -> str:
    said = (
        f"{s.steps} of {steps} steps do not settle within the usual most_s = {s.usual_s:g} "
        f"({two_digits(s.left_percent)} % left then): up to {s.longest_s:.0f} s are needed, as the "
        f"time above has it and [sweep.settle] below with most_s = {s.most_s:g}"
    )
    if s.never:
        said += (
            f", within which {s.never} do not settle either: the errors above are not those of such readings"
        )
    return said


def _level(level_g: float) -> str:
    """As the file has it, and in the unit chosen."""
    return f"level_g {level_g:g} ({acceleration_unit().typed(PUBLISHED_G_M_S2 * level_g)})"


def _levels(out: Output, found: PlanResult) -> None:
    if len(found.levels) < 2:
        return
    rows = [
        [
            f"{x.level_g:g}" + ("*" if x.level_g == found.level_g else ""),
            f"{acceleration_unit().of(PUBLISHED_G_M_S2 * x.level_g):.4g}",
            f"{x.steps}",
            f"{x.seconds:.0f}",
            two_digits(x.worst_percent),
            x.why_not,
        ]
        for x in found.levels
    ]
    out.table(
        "levels (steps for the law alone; * proposed: the lowest that is no slower)",
        ["level_g", f"level/({acceleration_unit().plain})", "steps", "s", "leaves/%", "exceeds"],
        rows,
    )


def _spots(out: Output, found: PlanResult) -> None:
    if not found.spots:
        return
    shown = [s for k, s in enumerate(found.spots) if k < _MOST_SPOTS or s.stated]
    out.table(
        f"spots (best {_MOST_SPOTS} of {len(found.spots)}; * the stated one)",
        ["x/mm", "y/mm", "steps", "s", "leaves/%", "least/%"],
        [_spot(s) for s in shown],
    )
    _map(out, found)


def _spot(s: SpotCompared) -> list[str]:
    return [
        f"{s.x_mm:.0f}" + ("*" if s.stated else ""),
        f"{s.y_mm:.0f}",
        f"{s.steps}",
        f"{s.seconds:.0f}" if s.reached else "-",
        two_digits(s.worst_percent),
        two_digits(s.limit_percent),
    ]


def _map(out: Output, found: PlanResult) -> None:
    """What the plan's rig time would leave at each spot, the clamp on the left."""
    grid = [s for s in found.spots if not s.stated]
    along, across = sorted({s.x_mm for s in grid}), sorted({s.y_mm for s in grid})
    at = {(s.x_mm, s.y_mm): two_digits(s.worst_percent) for s in grid}
    rows = [[f"{y:.0f}", *(at.get((x, y), "") for x in along)] for y in across]
    out.table(
        "map: % left in the plan's rig time; columns x/mm from the clamp, the other half of the width alike",
        ["y/mm", *(f"{x:.0f}" for x in along)],
        rows,
    )


def _effects(out: Output, found: PlanResult) -> None:
    if not found.effects:
        return
    out.table(
        "effects: from which size this plan sees them (4 sigma), and what they are mistaken for",
        ["effect", "seen from", "chance", "mistaken for (told apart at so many times it)"],
        [_effect(e) for e in found.effects],
    )
    for one in found.not_judged:
        out.say(f"{one.name}: {one.why}")


def _effect(e: EffectForecast) -> list[str]:
    said = [
        f"{r.name} ({two_digits(r.times)})" if r.times is not None else f"{r.name} (never)"
        for r in e.rivals[:_MOST_RIVALS]
    ]
    more = len(e.rivals) - _MOST_RIVALS
    return [
        e.name,
        _seen_from(e),
        f"{100 * e.chance_seen:.0f} %",
        ", ".join(said) + (f" and {more} more" if more > 0 else ""),
    ]


def _seen_from(e: EffectForecast) -> str:
    """Parameter, size and unit."""
    if e.parameter is None:
        return "any"
    size = ("-",) if e.seen_at is None else size_shown(e.seen_at, e.unit or "1")
    return " ".join([e.parameter, *filter(None, size)])
