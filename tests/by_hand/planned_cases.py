"""Simulated specimens for plans: plates of the solid model, known within drawn tolerances, read with
drawn noise."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import least_squares

from campaign.plates.cases import PlateTruth, draw_case
from campaign.plates.channel import ChannelError
from campaign.plates.simulate import built, moduli_of, reading
from campaign.plates.stated import CampaignTolerances, draw_stated, specimen_from, toml
from campaign.schedule import Schedule
from fitting.arrays import Array, Integers
from fitting.gravity import PUBLISHED_G_M_S2
from fitting.laws import CoreLaw
from fitting.planning.sensitivity import ReadingNoise
from fitting.specimen import PlateSpecimen
from fitting.sweep import Sweep

_SHARES = (0.1, 0.4)
"""Of a careful laboratory's tolerances: 2 % is out of reach of most plates that are known no better."""
_LAW_OFF = 0.1
"""How far the stated law's moduli are off, relative: a data sheet's."""


@dataclass(frozen=True)
class PlannedCase:
    """A specimen as a laboratory states it, and the rig that reads the true one."""

    seed: int
    truth: PlateTruth
    specimen: PlateSpecimen
    noise: ReadingNoise
    channel: ChannelError

    def measured(
        self,
        frequency_hz: Array,
        region: Integers,
        dwell_s: Array,
        time_s: Array,
        level_g: float,
        rng: np.random.Generator,
    ) -> Sweep:
        """What the rig reads, with the noise it states. Shapes (points,)."""
        count = len(frequency_hz)
        one = np.ones(count, dtype=np.intp)
        schedule = Schedule(frequency_hz, region, one, np.full(count, level_g), time_s)
        t = self.truth
        plate = built(t.plate, (), moduli_of(t.law, np.array(t.resonances_hz)))
        v = level_g * PUBLISHED_G_M_S2 * reading(plate, t.plate, (), t.law, schedule, self.channel)
        std = self.noise.std_m_s(v, dwell_s)
        scatter = rng.standard_normal((count, 2)) @ np.array([1, 1j])
        commanded = np.full(count, level_g * PUBLISHED_G_M_S2)
        return Sweep(frequency_hz, v + std * scatter, commanded, region, one, std_m_s=std, time_s=time_s)

    def law_at(self, frequency_hz: Array) -> Array:
        """The true G' in Pa and eta. Shape (2, frequencies)."""
        G = self.truth.law.modulus(2 * np.pi * frequency_hz)
        return np.array([G.real, G.imag / G.real])


def planned_case(seed: int) -> PlannedCase:
    """The same for the same seed."""
    truth = draw_case("none", seed).truth
    rng = np.random.default_rng([seed, 18])
    share = float(rng.uniform(*_SHARES))
    usual = CampaignTolerances()
    tolerances = CampaignTolerances(**{k: share * v for k, v in vars(usual).items()})
    stated = draw_stated(rng, truth.plate, tolerances)
    off = *rng.standard_normal(2), np.random.default_rng([seed, 19]).standard_normal()
    channel = ChannelError.within(tolerances, off)
    specimen = specimen_from(toml(stated, tolerances, truth.resonances_hz[1]))
    law = _stated_law(specimen, truth, rng)
    noise = ReadingNoise(float(10 ** rng.uniform(-6, -5)), float(rng.uniform(1e-3, 4e-3)))
    return PlannedCase(seed, truth, specimen.with_law(law), noise, channel)


def _stated_law(specimen: PlateSpecimen, truth: PlateTruth, rng: np.random.Generator) -> CoreLaw:
    """The law nearest to the truth of those a specimen states, moduli and rate off by as much as is usual."""
    f = np.geomspace(0.7 * truth.resonances_hz[0], 1.3 * truth.resonances_hz[-1], 40)
    wanted = np.log(truth.law.modulus(2 * np.pi * f))
    assert specimen.core is not None
    start = specimen.core.law.lifted()
    low, high = np.log([q.search for q in start.limits]).T

    def miss(logs: Array) -> Array:
        d = np.log(start.with_logs(logs).modulus(2 * np.pi * f)) - wanted
        return np.concatenate([d.real, d.imag])

    found = least_squares(miss, np.clip(np.log(start.values), low + 1e-6, high - 1e-6), bounds=(low, high))
    law = start.with_logs(found.x)
    scale = float(np.exp(_LAW_OFF * rng.standard_normal()))
    values = dict(zip(law.names, law.values, strict=True))
    return replace(law, g0_pa=scale * values["g0_pa"], ginf_pa=scale * values["ginf_pa"])  # type: ignore[call-arg]
