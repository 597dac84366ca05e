"""What every result is: frozen, typed, and the JSON that the commands write and a session keeps."""

from typing import Any, Self

from pydantic import BaseModel, ConfigDict


class Result(BaseModel):
    """Keys that were not given are not written: a file of an older version comes out as it went in.

    Keys that are not known, of a later version, are dropped.
    """

    model_config = ConfigDict(
        frozen=True,
        extra="ignore",
        validate_by_name=True,
        validate_by_alias=True,
        serialize_by_alias=True,
        defer_build=True,
    )

    def as_json(self) -> dict[str, Any]:
        """As JSON knows it: numbers, strings, lists, objects; None for NaN."""
        return self.model_dump(mode="json", exclude_unset=True)

    def but(self, **changes: Any) -> Self:
        """The same with some keys set. Raises `ValidationError`."""
        return type(self)(**{**self._given, **changes})

    def without(self, *keys: str) -> Self:
        """A copy of this result with some keys not given."""
        return type(self)(**{key: value for key, value in self._given.items() if key not in keys})

    @property
    def _given(self) -> dict[str, Any]:
        return {key: getattr(self, key) for key in type(self).model_fields if key in self.model_fields_set}
