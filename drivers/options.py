"""A device's table in RIG.toml, as far as every device has it; a driver's own model adds its keys."""

from pydantic import BaseModel, ConfigDict

SIMULATED = "simulated"
"""Address of a device that is stood up for the run, as `[simulation]` says."""
NOT_KEPT = "-"
"""Address of a simulated device in a session: it was another one each time."""


class DeviceOptions(BaseModel):
    """Unknown keys and wrong types are refused. What stands below a key describes it."""

    model_config = ConfigDict(extra="forbid", strict=True, defer_build=True)

    kind: str
    """Which driver."""
    address: str
    """Where it answers."""

    @property
    def is_addressed(self) -> bool:
        """Whether the address is a device's own, to be judged."""
        return self.address not in (SIMULATED, NOT_KEPT)
