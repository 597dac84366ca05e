"""The operator: what only a person can do, asked for in words; or a stand-in where the rig is simulated."""

from typing import Protocol

import click
import httpx

from instrument.errors import RigStopped
from instrument.stream.raw import OperatorDid

_PATIENCE_S = 10.0


class Operator(Protocol):
    """Someone at the rig."""

    def mount(self, plate: str) -> OperatorDid:
        """Mount the bare or the damped plate ("bare", "damped"); returns when it is done."""
        ...

    def aim(self, point: str) -> OperatorDid:
        """Aim the laser at the base or at the pickup ("base", "pickup"); returns when it is done."""
        ...

    def hit(self, number: int, wanted: int) -> list[OperatorDid]:
        """Asked for the next blow; what was decided about earlier ones meanwhile. Does not wait."""
        ...


class Person:
    """Told on the terminal, answers with Enter."""

    def mount(self, plate: str) -> OperatorDid:
        """Ask, and wait for Enter."""
        self._ask(f"Mount the {plate} plate, then press Enter")
        return OperatorDid("mounted", plate)

    def aim(self, point: str) -> OperatorDid:
        """Ask, and wait for Enter."""
        where = "base beside the accelerometer" if point == "base" else point
        self._ask(f"Aim the laser at the {where}, focus, then press Enter")
        return OperatorDid("aimed", point)

    def hit(self, number: int, wanted: int) -> list[OperatorDid]:
        """Say which blow is next."""
        click.echo(
            f"Hit {number} (good so far: {number - 1} of {wanted}): strike once, let it ring", err=True
        )
        return []

    def _ask(self, text: str) -> None:
        click.echo(f"{text} ... ", err=True, nl=False)
        try:
            input()
        except EOFError:
            raise RigStopped(f"nobody answered: {text}") from None


class SimulatedOperator:
    """Acts on the simulated rig through its side door."""

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

    def hit(self, number: int, wanted: int) -> list[OperatorDid]:
        """A blow, a little harder or softer than the last."""
        self._put("hit", {})
        return []

    def _put(self, what: str, body: dict[str, object]) -> None:
        try:
            httpx.put(f"{self._url}/simulated/{what}", json=body, timeout=_PATIENCE_S).raise_for_status()
        except httpx.HTTPError as error:
            raise RigStopped(f"simulated rig at {self._url}: {what}: {error}") from None
