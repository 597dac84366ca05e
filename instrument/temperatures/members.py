"""One specimen at one temperature, fitted by itself: what a fit over temperatures begins with."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from typing import Any

import numpy as np

from fitting.arrays import Array
from fitting.data.noise import noise_of
from fitting.data.strays import strays
from fitting.diagnosis.inference.begin import begin
from fitting.diagnosis.several.several_problem import SeveralProblem
from fitting.effects.base import Effect
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.mode_tables.build import member_of
from fitting.mode_tables.fit import BegunModal, start_of
from fitting.mode_tables.member import Member
from fitting.mode_tables.misread import misread
from fitting.mode_tables.standing import standing
from fitting.mode_tables.table import ModalTable
from fitting.progress import Report, unheard
from fitting.specimen import PlateSpecimen
from fitting.structures import AnySpecimen, Beam
from fitting.sweep import Sweep
from fitting.temperature.members import Alone, Joined
from fitting.temperature.sweeps import AloneSweep, Sweeps
from fitting.temperature.tables import Tables, alone
from fitting.widened.enriching import reach_over
from instrument.errors import BadInput
from instrument.finding.effect_names import effects_among
from instrument.finding.files_at_work import FilesAtWork
from instrument.finding.modal import widened
from instrument.mistakes.modal_look import numbering_doubt
from instrument.mistakes.shifted_mistakes import doubt_at_temperatures
from instrument.models.files import File
from instrument.models.set_up import Hammer, set_up
from instrument.progress import quiet
from instrument.remarks.as_given import remarks_on_noise, remarks_on_strays
from instrument.temperatures.odd_rows import OddRow, words_of


@dataclass(frozen=True)
class AtTemperature:
    """What was measured of one specimen at one temperature of its core."""

    data: Sweep | ModalTable
    temperature_c: float
    name: str = ""
    specimen: int = 1
    """Its number: what has one number is one thing that stayed where it is."""


@dataclass
class Members:
    """All of them, with what each was measured on."""

    every: Sequence[AtTemperature]
    specimens: Sequence[AnySpecimen]
    """By their numbers, from 1."""
    hammer: Hammer | None = None
    own_spots: bool = False
    """Whether the laser was aimed anew at each sweep of a specimen."""
    remarks: list[str] = field(default_factory=list)
    """What is to be said of the data."""

    @property
    def are_tables(self) -> bool:
        """Whether they are modes."""
        return isinstance(self.every[0].data, ModalTable)

    @property
    def scale_known(self) -> bool:
        """Whether every table states how well its numbers are known; a sweep's noise knows itself."""
        tables = [one.data for one in self.every if isinstance(one.data, ModalTable)]
        return all(t.states_its_noise for t in tables)

    @property
    def numbers(self) -> list[int]:
        """The number of each member's specimen."""
        return [one.specimen for one in self.every]

    def specimen(self, one: AtTemperature) -> AnySpecimen:
        """What one was measured on, as warm as it was."""
        stated = self.specimens[one.specimen - 1]
        return stated.at_temperature(one.temperature_c) if isinstance(stated, Beam) else stated

    def alone(self, report: Report, *, with_effects: bool) -> list[Alone]:
        """Each by itself; with models that effects can change, or without."""
        self.remarks.clear()
        fit = self._table if self.are_tables else self._sweep
        found = []
        for k, one in enumerate(self.every):
            found.append(fit(one, with_effects=with_effects))
            report((k + 1) / len(self.every))
        return found

    def read_otherwise(self, alone: Sequence[Alone]) -> str:
        """What to ask of tables that fit far better in another unit; empty where none does."""
        tables = [one.data for one in self.every if isinstance(one.data, ModalTable)]
        if not self.are_tables:
            return ""

        def left_by(others: Sequence[ModalTable]) -> Array:
            every = [replace(one, data=table) for one, table in zip(self.every, others, strict=True)]
            return _left(
                replace(self, every=every, remarks=[], _plates={}).alone(unheard, with_effects=False)
            )

        T = [one.temperature_c for one in self.every]
        near_hz = np.exp(np.concatenate([a.begun.none.velocity_m_s.real for a in alone]))
        with np.errstate(all="ignore"):
            return doubt_at_temperatures(tables, T, _left(alone), near_hz, left_by)

    def odd_rows(self, alone: Sequence[Alone]) -> list[str]:
        """Of tables, each by itself: a mode that does not go with the others, for people.

        Raises `BadInput` where no numbering of modes can be as stated.
        """
        if not self.are_tables:
            return []
        rows, ratios = list[OddRow](), []
        for one, its in zip(self.every, alone, strict=True):
            assert isinstance(one.data, ModalTable)
            near = its.begun.none.velocity_m_s.real
            ratios.append(near - np.log(one.data.frequency_hz))
            odd = misread(its.begun) if isinstance(its.begun, BegunModal) else None
            # What a law may take up at one temperature is seen by all of them, and more than a row may do it.
            if odd is not None and odd.plain:
                rows.append(OddRow(one.temperature_c, one.data, odd))
        doubt = numbering_doubt(ratios)
        if doubt:
            raise BadInput(f"{', '.join(dict.fromkeys(one.name for one in self.every))}: {doubt}")
        return words_of(rows, len(self.every))

    def joined(self, begun: Sequence[Any]) -> Joined:
        """Fits of each by itself, side by side."""
        if self.are_tables:
            return Tables.of(begun, self.numbers)
        return Sweeps.of(begun, self.numbers, own_spots=self.own_spots)

    @property
    def effects(self) -> list[Effect]:
        """The forms that effects have on all of them."""
        if self.are_tables:
            return standing(self.specimens)
        return [effect for effect, _ in effects_among(self.specimens)]

    def _sweep(self, one: AtTemperature, *, with_effects: bool) -> AloneSweep:
        specimen, sweep = self.specimen(one), one.data
        assert isinstance(sweep, Sweep)
        assert specimen.core is not None
        clean = sweep.take(strays(sweep) == 0)
        said = (*remarks_on_strays(sweep), *remarks_on_noise(clean))
        self.remarks += [f"{one.name}: {text}" for text in said]
        if isinstance(specimen, PlateSpecimen):
            sweep = clean
            noise = noise_of(sweep)
            ready = set_up(sweep, specimen, self.hammer, with_effects=with_effects)
            found = begin(ready.problem, ready.reduced, noise, ready.bare, specimen.core.law)
            return AloneSweep(found, ready.reduced, noise)
        files = [File(sweep, specimen, one.name)]
        work = FilesAtWork(files, quiet, with_effects=with_effects)
        work.set_disturbances_aside()
        found, noise = work.fit()
        self.remarks += [aside.words(files) for aside in work.aside]
        assert isinstance(found.problem, SeveralProblem)
        return AloneSweep(replace(found, problem=found.problem.members[0]), None, noise)

    def _table(self, one: AtTemperature, *, with_effects: bool) -> Alone:
        assert isinstance(one.data, ModalTable)
        try:
            return alone(self._member(one, with_effects=with_effects), self._start)
        except OutsideModel as error:
            raise OutsideModel(f"{one.name} at {one.temperature_c:g} degC: {error}") from None

    @property
    def _start(self) -> CoreLaw:
        tables = [one.data for one in self.every if isinstance(one.data, ModalTable)]
        return start_of(tables, [self.specimens[one.specimen - 1] for one in self.every])

    def _member(self, one: AtTemperature, *, with_effects: bool) -> Member:
        assert isinstance(one.data, ModalTable)
        specimen = self.specimen(one)
        if not isinstance(specimen, PlateSpecimen):
            return member_of(one.data, specimen)
        # A plate's motions are dear, and the same at all of its temperatures.
        key = one.specimen, with_effects
        if key not in self._plates:
            its = [
                o.data for o in self.every if o.specimen == one.specimen and isinstance(o.data, ModalTable)
            ]
            most = max(its, key=lambda table: float(table.mode.max()))
            reach = reach_over(max(its, key=lambda table: float(table.frequency_hz.max())).frequency_hz)
            widen = partial(widened, report=unheard, reach_hz=reach) if with_effects else None
            self._plates[key] = member_of(most, specimen, widen)
        return replace(self._plates[key], table=one.data)

    _plates: dict[tuple[int, bool], Member] = field(default_factory=dict)


def _left(alone: Sequence[Alone]) -> Array:
    """Chi-square of each. Shape (members,)."""
    return np.array([a.begun.none.chi2 for a in alone])
