"""The operator: what only a person can do, asked for in words; or a stand-in where the rig is simulated."""

import os
import select
import sys
from typing import Literal, Protocol

import click
import httpx

from instrument.errors import RigStopped
from instrument.facts.follow_up import FollowUp
from instrument.results.next_words import apart_words, duration
from instrument.run.control import RunControl
from instrument.stream.raw import OperatorDid

_PATIENCE_S = 10.0
_BUILDING_S = 120.0
"""For a plate that the simulated rig has not hung before: its solid is built then."""
_MOST_HZ = 1e5


class Operator(Protocol):
    """Someone at the rig."""

    def mount(self, plate: str) -> OperatorDid:
        """Mount the specimen "bare" or "damped", without a known mass; returns when it is done."""
        ...

    def aim(self, point: str) -> OperatorDid:
        """Aim the laser at the base or at the pickup ("base", "pickup"); returns when it is done."""
        ...

    def hit(self, good: int, wanted: int) -> None:
        """Asked for the next blow. Does not wait."""
        ...

    def decided(self) -> list[OperatorDid]:
        """What was decided about hits since the last time. Does not wait."""
        ...

    def content(self, good: int) -> bool:
        """Whether the hits may be used, now that there are enough. Does not wait."""
        ...

    def agree(self, offer: FollowUp) -> bool:
        """Whether this may be measured next."""
        ...

    def change(self, offer: FollowUp) -> OperatorDid:
        """Do what it needs hands for; returns when it is done."""
        ...

    def overrule(self, control: RunControl) -> None:
        """Pass on what was said to the sweep since the last time. Does not wait."""
        ...


def decision(line: str) -> OperatorDid | None:
    """What a typed line means; None where it means nothing."""
    words = line.split()
    meanings: dict[str, Literal["accepted", "rejected", "undone"]] = {
        "a": "accepted",
        "r": "rejected",
        "u": "undone",
    }
    if not 1 <= len(words) <= 2 or words[0] not in meanings or not all(w.isdecimal() for w in words[1:]):
        return None
    return OperatorDid(meanings[words[0]], "", int(words[1]) if len(words) == 2 else 0)


def overruling(line: str, control: RunControl) -> str:
    """Do what a typed line asks of a sweep; what there is to say to it, empty where it was done."""
    words = line.split()
    match words:
        case ["s"]:
            control.decline()
        case ["e" | "+", *_] if not control.chooses_steps:
            return f"{words[0]} is for a sweep that chooses its own steps; this one leaves a step out by s"
        case ["e"]:
            control.overrule("end")
        case ["+", said] if _frequency(said) is not None:
            control.overrule("add", _frequency(said))
        case _:
            more = ", + 45.2 (add a step) or e (end)" if control.chooses_steps else ""
            return f"expected s (leave this step out){more}"
    return ""


def _frequency(said: str) -> float | None:
    try:
        found = float(said)
    except ValueError:
        return None
    return found if 0 < found < _MOST_HZ else None


def follow_up_words(offer: FollowUp) -> str:
    """What it costs and what may be hoped for, in a line."""
    chance = f"{100 * offer.probability_resolved:.0f} % that one explanation is left"
    steps = f"{len(offer.frequencies_hz)} steps, " if offer.frequencies_hz else ""
    return f"{steps}{duration(offer.seconds)}, {chance}"


def _at_a_terminal() -> bool:
    return sys.stdin is not None and not sys.stdin.closed and sys.stdin.isatty()


def _heed_typed(control: RunControl) -> None:
    """Do what lines typed meanwhile ask of a sweep."""
    while _at_a_terminal() and _in_front() and select.select([sys.stdin], [], [], 0)[0]:
        line = sys.stdin.readline()
        if not line:
            return
        if line.strip() and (said := overruling(line, control)):
            click.echo(said, err=True)


def _in_front() -> bool:
    """Whether what is typed is for this job: one in the background would be stopped for reading it."""
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:
        return False


_TYPED = "r rejects the last hit, a accepts, u undoes; r 2 the second; then Enter"


class Person:
    """Told on the terminal, answers with Enter."""

    def __init__(self) -> None:
        self._content: bool | None = None

    def mount(self, plate: str) -> OperatorDid:
        """Ask, and wait for Enter."""
        self._ask(f"Mount the {plate} specimen, nothing else on it, then press Enter")
        return OperatorDid("mounted", plate)

    def aim(self, point: str) -> OperatorDid:
        """Ask, and wait for Enter."""
        where = "base beside the accelerometer" if point == "base" else point
        self._ask(f"Aim the laser at the {where}, focus, then press Enter")
        return OperatorDid("aimed", point)

    def hit(self, good: int, wanted: int) -> None:
        """Say what is next, and what may be typed."""
        self._content = None
        typed = "" if good == 0 else f" ({_TYPED})"
        click.echo(f"{good} of {wanted} good hits: strike once and let it ring{typed}", err=True)

    def decided(self) -> list[OperatorDid]:
        """Lines typed meanwhile: r, a or u, a hit's number after it where it is not the last."""
        found = []
        while _at_a_terminal() and select.select([sys.stdin], [], [], 0)[0]:
            line = sys.stdin.readline()
            did = decision(line)
            if did is not None:
                found.append(did)
            elif not line.strip():
                self._content = True
            else:
                click.echo(f"expected {_TYPED}", err=True)
        return found

    def content(self, good: int) -> bool:
        """Whether the hits may be used: Enter, once there are enough."""
        if not _at_a_terminal():
            return True
        if self._content is None:
            self._content = False
            click.echo(f"{good} good hits: Enter to go on ({_TYPED})", err=True)
        return self._content

    def agree(self, offer: FollowUp) -> bool:
        """Ask; where nobody is there to answer, no."""
        click.echo(f"{apart_words(offer.between)}: {offer.todo} {offer.why}", err=True)
        click.echo(f"{follow_up_words(offer)}. Enter to measure it, n not to ... ", err=True, nl=False)
        try:
            return input().strip().lower() in ("", "y", "yes")
        except (EOFError, RuntimeError, OSError):
            return False

    def change(self, offer: FollowUp) -> OperatorDid:
        """Ask, and wait for Enter."""
        self._ask(f"{offer.todo.rstrip('.')}, then press Enter")
        return OperatorDid("changed", offer.todo)

    def overrule(self, control: RunControl) -> None:
        """Lines typed meanwhile: s leaves the step out, + 45.2 adds one, e ends the sweep."""
        _heed_typed(control)

    def _ask(self, text: str) -> None:
        click.echo(f"{text} ... ", err=True, nl=False)
        try:
            input()
        except (EOFError, RuntimeError, OSError):
            # The end of a file, or no standard input at all.
            raise RigStopped(f"nobody answered: {text}") from None


class SimulatedOperator:
    """Acts on the simulated rig through its operator channel."""

    def __init__(self, url: str, hit_m: tuple[float, float], response_m: tuple[float, float]) -> None:
        self._url, self._hit_m, self._response_m = url, hit_m, response_m

    def mount(self, plate: str) -> OperatorDid:
        """The rig does it at once."""
        self._put("mount", {"plate": plate, "hit_m": self._hit_m, "response_m": self._response_m})
        return OperatorDid("mounted", plate)

    def aim(self, point: str) -> OperatorDid:
        """The rig does it at once."""
        self._put("aim", {"point": point})
        return OperatorDid("aimed", point)

    def hit(self, good: int, wanted: int) -> None:
        """A blow, a little harder or softer than the last."""
        self._put("hit", {})

    def decided(self) -> list[OperatorDid]:
        """Nothing: the program's own verdict stands."""
        return []

    def content(self, good: int) -> bool:
        """Always."""
        return True

    def agree(self, offer: FollowUp) -> bool:
        """Always."""
        return True

    def change(self, offer: FollowUp) -> OperatorDid:
        """The rig does it at once. Raises `RigStopped` for what it cannot play."""
        if offer.spot_mm is not None and offer.kind != "damped_struck":
            x, y = offer.spot_mm
            self._put("aim", {"point": "pickup", "at_m": (1e-3 * x, 1e-3 * y)})
        elif offer.mass_kg is not None and offer.mass_at_mm is not None:
            x, y = offer.mass_at_mm
            self._put("load", {"mass_kg": offer.mass_kg, "at_m": (1e-3 * x, 1e-3 * y)})
        elif offer.kind == "clamping":
            self._put("clamp", {})
        elif offer.kind == "damped_struck" and offer.struck_mm is not None:
            self._strike(offer.struck_mm, offer.spot_mm, free=offer.held == "free")
        else:
            raise RigStopped(f"simulated rig: {offer.kind} cannot be played")
        return OperatorDid("changed", offer.todo)

    def overrule(self, control: RunControl) -> None:
        """Of itself never; who sits at the terminal may, as on a real rig."""
        _heed_typed(control)

    def _strike(
        self, struck_mm: tuple[float, float], spot_mm: tuple[float, float] | None, *, free: bool
    ) -> None:
        hit, read = (None if at is None else (1e-3 * at[0], 1e-3 * at[1]) for at in (struck_mm, spot_mm))
        self._put("strike", {"free": free, "hit_m": hit, "read_m": read}, _BUILDING_S)

    def _put(self, what: str, body: dict[str, object], patience_s: float = _PATIENCE_S) -> None:
        try:
            # On this machine: past any proxy of the environment, and without certificates to read.
            httpx.put(
                f"{self._url}/simulated/{what}",
                json=body,
                timeout=patience_s,
                trust_env=False,
                verify=False,
            ).raise_for_status()
        except httpx.HTTPError as error:
            raise RigStopped(f"simulated rig at {self._url}: {what}: {error}") from None
