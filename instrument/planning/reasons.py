"""Why a measurement tells explanations apart: what it shows of each of them, in words."""

from collections.abc import Iterable, Iterator

from fitting.diagnosis.verdict.names import split
from fitting.effects import CATALOGUE
from fitting.effects.base import CLAMP
from instrument.facts.follow_up import FollowUpKind

_CLAMP = "a clamp"
_SHOWN: dict[FollowUpKind, dict[str, str]] = {
    "level": {"level": "what depends on the amplitude changes with the level"},
    "reversed": {"time": "what drifts follows the clock and not the frequency"},
    "frequencies": {},
    "spot": {
        "spot_offset": "an offset belongs to one spot alone",
        "absolute_velocity": "the base's own motion is added alike at every spot",
        "partial_debond": "where the core is loose the modes change their shape",
        "uneven_clamp": "a clamp that is uneven twists the plate across its width",
        "air_added_mass": "air hardly changes the shape of a mode",
        "clamp_line": "where the clamp begins moves the nodes of all modes the same way",
        "treatment_not_gripped": "a treatment that is not gripped lets the core shear at the root",
        _CLAMP: "a clamp that gives moves the plate near its root, where a stiff one holds it",
        "channel": "what is wrong in the channel is the same at every spot",
        "mass": "what sits on the plate moves the nodes of its modes",
        "load": "a base that tilts adds a motion that grows along or across the plate",
        "stiffness": "what the whole plate is made of changes each spot as the shapes of the modes say",
        "core law": "what the core is changes each spot as the shapes of the modes say",
    },
    "added_mass": {
        "air_added_mass": "the air's mass is spread, the known one sits at one place",
        "spot_offset": "an offset of the spot does not feel a mass",
        _CLAMP: "how far a known mass lowers each mode tells how the root is held",
        "channel": "what is wrong in the channel does not feel a mass",
        "mass": "what a known mass adds tells how much was there before",
        "load": "a known mass moves the plate's resonances and hardly the fixture's",
        "stiffness": "how far a known mass lowers a resonance tells stiffness from mass",
    },
    "clamping": {
        "spot_offset": "the spot is aimed at once more",
        _CLAMP: "clamped anew the clamp is another one",
        "channel": "the channel stays as it is",
        "mass": "what sits on the plate stays on it",
        "load": "the base stays as it is",
        "stiffness": "what the plate is made of stays the same",
    },
    "bare_hammer": {
        "substrate_stiffness": "the bare plate's frequencies show its metal alone",
        "orthotropic_substrate": "the bare plate's frequencies show its metal alone",
        "air_added_mass": "the bare plate moves the same air or none",
        "spot_offset": "no laser reads the bare plate",
        _CLAMP: "a metal that is known leaves the rest to the clamp",
        "channel": "no laser reads the bare plate",
        "mass": "what sits on the treated plate is not on the bare one",
        "load": "a hammer needs no base that moves",
        "stiffness": "the bare plate has neither core nor constraining layer",
        "core law": "the bare plate has no core",
    },
    "damped_struck": {
        "spot_offset": "the spot is aimed at once more",
        _CLAMP: "hung free the plate has no clamp",
        "channel": "another channel is the reference",
        "mass": "how far a force moves the plate tells what moves along with it",
        "load": "a hammer needs no base that moves",
        "stiffness": "its free resonances tell its stiffness, whatever held it before",
        "core law": "its free resonances show the core at other frequencies",
        "damping": "hung by threads hardly anything but the core takes energy",
    },
}
"""By effect, or by where it enters."""
_ALWAYS: dict[FollowUpKind, str] = {
    "level": "all else goes in proportion to it",
    "reversed": "all else is read again as it was",
    "frequencies": "The same steps once more halve the noise",
}
"""Whichever the explanations are."""
_MOST_REASONS = 3
"""Reasons that a sentence names: more are not read. A choice."""


def why(kind: FollowUpKind, explanations: Iterable[str]) -> str:
    """One sentence on what tells these explanations, each by its name, apart."""
    effects = [e for names in explanations for e in split(names)]
    shown = [words for words in dict.fromkeys(_shown(kind, e) for e in effects) if words]
    said = [*shown[:_MOST_REASONS], *([_ALWAYS[kind]] if kind in _ALWAYS else [])]
    if not said:
        return "The explanations expect other readings there."
    text = "; ".join(said)
    return f"{text[0].upper()}{text[1:]}."


def _shown(kind: FollowUpKind, effect: str) -> str:
    return next((_SHOWN[kind][trait] for trait in _traits(effect) if trait in _SHOWN[kind]), "")


def _traits(effect: str) -> Iterator[str]:
    """The narrowest first."""
    yield effect
    known = CATALOGUE.get(effect)
    if known is not None:
        if known.needs >= CLAMP:
            yield _CLAMP
        yield known.enters
