"""What an axis of a plot shows."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Axis:
    """The quantity on an axis, and how it is drawn."""

    label: str
    unit: str = ""
    log: bool = False
    titled: bool = True
    """Whether it is named beside the axis: of plots in a column the lowest one does for all."""
    symbol: str = ""
    """Said in place of the label where there is no room for it."""

    @property
    def title(self) -> str:
        """As it stands beside the axis."""
        if not self.titled:
            return ""
        return f"{self.label} / {self.unit}" if self.unit else self.label

    @property
    def titles(self) -> tuple[str, ...]:
        """As it may stand beside the axis, the longest first."""
        if not self.titled:
            return ("",)
        short = (f"{self.symbol} / {self.unit}" if self.unit else self.symbol,) if self.symbol else ()
        return (self.title, *short, self.unit)

    @property
    def column(self) -> str:
        """As it heads a column of exported data."""
        return f"{self.label} ({self.unit})" if self.unit else self.label
