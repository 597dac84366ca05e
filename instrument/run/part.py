"""What a run may consist of."""

from typing import Literal

Part = Literal["hammer", "sweep"]
