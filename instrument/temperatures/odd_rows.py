"""Rows that do not go with the others at their temperatures: of one mode at several, something acts on it."""

from collections.abc import Sequence
from dataclasses import dataclass

from fitting.digits import two_digits
from fitting.mode_tables.misread import Misread
from fitting.mode_tables.table import ModalTable
from instrument.remarks.modal_remarks import remark_on_misread


@dataclass(frozen=True)
class OddRow:
    """The odd one of a table by itself."""

    temperature_c: float
    table: ModalTable
    odd: Misread

    @property
    def mode(self) -> int:
        """Its number."""
        return int(self.table.mode[self.odd.place])

    @property
    def off_percent(self) -> float:
        """The table's frequency over where the others have it, less one."""
        return 100 * float(self.table.frequency_hz[self.odd.place] / self.odd.frequency_hz - 1)


def words_of(rows: Sequence[OddRow], tables: int) -> list[str]:
    """For people, a sentence for each mode that is odd at several of so many `tables`, else for each row."""
    said = []
    for mode in dict.fromkeys(row.mode for row in rows):
        its = [row for row in rows if row.mode == mode]
        if len(its) > 1:
            said.append(_at_several(mode, its, tables))
        else:
            row = its[0]
            said.append(f"at {row.temperature_c:g} degC {remark_on_misread(row.odd, [row.table])}")
    return said


def _at_several(mode: int, rows: Sequence[OddRow], tables: int) -> str:
    several = f"at {', '.join(f'{row.temperature_c:g}' for row in rows)} degC"
    where = "at any temperature" if len(rows) == tables else several
    off = sorted(row.off_percent for row in rows)
    return (
        f"mode {mode} does not go with the others {where}: its frequency is {_signed(off[0])} to "
        f"{_signed(off[-1])} % beside where one law of the others has it: something acts on it (a mass, a "
        "magnet, a cable). With these rows left out there is a law; with them there is none to be trusted"
    )


def _signed(value: float) -> str:
    return f"{'+' if value > 0 else ''}{two_digits(value)}"
