"""A diagnosis made by hand: what is said of it does not depend on how it was found."""

import numpy as np
from paper_law import TABLE_4

from fitting.data.aside import reasons
from fitting.diagnosis.verdict.result import Candidate, Diagnosis, FoundEffect, ParameterEstimate, Stage
from fitting.identification.result import law_band
from fitting.identification.uncertainty import Uncertainty
from fitting.identification.validation import HeldOutSegment, Validation
from fitting.sweep import Sweep
from instrument.facts.diagnosis import UnseenEffect
from instrument.files.specimen_file import read_specimen
from instrument.finding.diagnosis import Diagnosed
from instrument.models.files import File
from instrument.paper_case import case_file
from instrument.results.diagnosis_from import diagnosis_from

MASS = FoundEffect(
    "added_mass", {"mass": ParameterEstimate(0.008, 1e-4, "kg"), "x": ParameterEstimate(0.25, np.nan, "m")}
)
SPOT = FoundEffect("spot_offset", {"dx": ParameterEstimate(0.004, 2e-5, "m")})
HUM = FoundEffect("mains_hum", {"amplitude": ParameterEstimate(1e-4, 1e-5, "m/s")})
BEFORE, AFTER = 0.1 + 0.05j, 0.001 - 0.002j
"""Predicted over measured, less one."""


def sweep(*, phase=True):
    """Three segments of ten points, two of them at the mains' frequencies."""
    f = np.concatenate([np.linspace(a, b, 10) for a, b in ((18, 22), (90, 110), (240, 300))])
    v = (0.1 + 0.02j) * 20 / f
    n = len(f)
    return Sweep(
        frequency_hz=f,
        velocity_m_s=v if phase else np.abs(v),
        commanded_m_s2=np.full(n, 9.81),
        segment=np.repeat([1, 2, 3], 10),
        sweep=np.ones(n, dtype=np.intp),
        std_m_s=1e-3 * np.abs(v),
        time_s=np.arange(float(n)),
    )


def used(s):
    """All but the points nearest to 100 and 300 Hz."""
    keep = np.ones(len(s), bool)
    keep[[np.argmin(np.abs(s.frequency_hz - f)) for f in (100, 300)]] = False
    return keep


def stage(s, off, *, one_by_one=None):
    predicted = s.response_m_s * (1 + off)
    n = len(TABLE_4.values)
    uncertainty = Uncertainty(1e-4 * np.eye(n), {}, 1.0)
    held = tuple(HeldOutSegment(k, 100 * abs(off), 0.1) for k in (1, 2, 3))
    parts = 2 if s.has_phase else 1
    return Stage(
        law=TABLE_4,
        standard_errors=dict(zip(TABLE_4.names, 0.01 * TABLE_4.values, strict=True)),
        band=law_band(s, TABLE_4, uncertainty),
        predicted_m_s=predicted,
        difference_percent=100 * (np.abs(predicted) / np.abs(s.response_m_s) - 1),
        whitened=np.arange(float(parts * len(s))),
        chi2_per_dof=abs(off) * 100,
        validation=Validation(leave_one_out_rms_percent=one_by_one)
        if one_by_one is not None
        else Validation(held_out=held, held_out_rms_percent=100 * abs(off)),
        correlations={a: {b: float(a == b) for b in TABLE_4.names} for a in TABLE_4.names},
        structure=("its signs keep together",) if abs(off) > 0.05 else (),
    )


def diagnosed(s, files=None, *, verdict="effect", one_by_one=None):
    """An added mass, hum in a channel, an alternative and a pair; of one plate where no `files` are given."""
    keep = used(s)
    part = s.take(keep)
    result = Diagnosis(
        verdict=verdict,
        effects=(MASS,),
        channels=(HUM,),
        equivalent={
            "added_mass": ("added_mass", "spot_offset") if verdict == "ambiguous" else ("added_mass",)
        },
        candidates=(
            Candidate((MASS,), 0.0, 1.0, 0.82),
            Candidate((SPOT,), 3.5, 1.02, 0.14),
            Candidate((MASS, SPOT), 6.0, 1.0, 0.04),
            Candidate((), 400.0, 9.0, 0.0),
        ),
        before=stage(part, BEFORE, one_by_one=one_by_one),
        after=stage(part, AFTER, one_by_one=one_by_one),
        next_measurement="To confirm: the mass taken off.",
        explanation=("The stated plate leaves 10 % rms.", "Most likely a mass of 8 g sits on it."),
        why_aside=reasons(~keep, "mains_hum"),
        warnings=("the points carry no time",),
    )
    files = files or [File(s, read_specimen(case_file("zn1.toml")))]
    return Diagnosed(result, tuple(files), s, 1.5, 0.25)


UNSEEN = (
    UnseenEffect(
        name="temperature_drift",
        chance=0.04,
        parameter="warming",
        size=2.27,
        unit="K",
        storage_modulus_percent=26.9,
        loss_factor_percent=7.7,
        standard_errors=8.0,
    ),
    UnseenEffect(
        name="absolute_velocity",
        chance=0.02,
        storage_modulus_percent=4.0,
        loss_factor_percent=9.0,
        standard_errors=3.0,
    ),
)


def diagnosis(**how):
    """Its result."""
    s = sweep(phase=how.pop("phase", True))
    return diagnosis_from(diagnosed(s, **how))
