"""What is to be said of files as they were given, each by its name where there are several."""

from collections.abc import Collection, Sequence

import numpy as np

from fitting.arrays import Array
from fitting.data.levels import count_of_levels
from fitting.data.noise import noise_of
from fitting.data.strays import strays
from fitting.digits import two_digits
from fitting.identification.law_remarks import CORE_PA
from fitting.identification.validation import HeldOutSegment, rms
from fitting.laws import CoreLaw
from fitting.structures import AnySpecimen, Beam, ShearPair
from fitting.structures.shear_pair import EDGE
from fitting.sweep import Sweep
from instrument.models.files import File
from instrument.remarks.as_given import (
    remarks_on_law,
    remarks_on_noise,
    remarks_on_patches,
    remarks_on_strays,
    remarks_on_tolerances,
)
from instrument.remarks.clamp_remarks import remarks_on_clamps

_WORTH_SAYING = 0.01
"""Of the modulus: a correction that is left out."""
_AS_WIDE = 1.0 + 1e-9
"""Of r_o - r_i: up to here solid discs are within 1.3 % of what is counted, as much as is left open."""
_FAR = 10.0
"""Times the modulus of the law in a file: more is asked about."""
_OFF_PERCENT = 10.0
"""Of a reading, rms: more than any rig is off."""
_HOLDER_N_M, _GIVES_WAY = 1e8, 0.02
"""How stiff a good holder is, screws and adherends in it, and from what share of it pads are asked about."""
_TIMES_NOISE = 4.0
"""What a fit leaves over its noise, rms: clean files leave hardly more than their noise. A choice."""


def remarks_on_files(files: Sequence[File]) -> tuple[str, ...]:
    """Of their noise, tolerances, laws, and what a pair's discs and a beam's clamps leave out; each once."""
    named: dict[str, dict[str, None]] = {}
    """What is said, and of which files; of none by name where it is of the law."""
    clean = [file.sweep.take(strays(file.sweep) == 0) for file in files]
    known = any(noise_of(sweep).is_known for sweep in clean)
    for file, sweep in zip(files, clean, strict=True):
        s = file.specimen
        of_file = (
            *remarks_on_strays(file.sweep),
            *remarks_on_noise(sweep, others_known=known),
            *remarks_on_tolerances(s),
            *remarks_on_patches(s),
            *remarks_on_edges(s),
            *remarks_on_holder(sweep, s),
            *remarks_on_clamps(s),
        )
        for text in of_file:
            named.setdefault(text, {})[file.name] = None
        of_law = remarks_on_law(s.core.law, file.sweep.frequency_hz) if s.core is not None else ()
        for text in of_law:
            named.setdefault(text, {})
    everyone = {file.name for file in files}
    for text in remarks_on_strain(files):
        named.setdefault(text, {})
    return tuple(_of(names, everyone) + text for text, names in named.items())


def remarks_on_rest(rms_percent: float, held_out: Sequence[HeldOutSegment]) -> tuple[str, ...]:
    """That a fit leaves far more of the readings than noise, though what may be off explains it."""
    noise = rms(np.array([h.noise_percent for h in held_out])) if held_out else np.nan
    if not rms_percent > _TIMES_NOISE * noise:
        return ()
    left, times = two_digits(rms_percent), two_digits(rms_percent / noise)
    return (
        f"the fit leaves {left} % of the readings (rms), {times} times their noise: counted as what "
        "channels and theory may be off by, slowly with frequency; an effect may look like that, see "
        "'viscorig diagnose'",
    )


def _of(names: Collection[str], everyone: Collection[str]) -> str:
    """Whose a remark is; empty where it is of all of them."""
    known = [name for name in names if name]
    return f"{', '.join(known)}: " if known and len(names) < len(everyone) else ""


def remarks_on_edges(specimen: AnySpecimen) -> tuple[str, ...]:
    """Where the free edges of a pair's discs matter and are not counted, or beyond what counts them."""
    if not isinstance(specimen, ShearPair):
        return ()
    if specimen.edges:
        return _beyond_edges(specimen)
    missing = specimen.left_out_by_edges
    if missing < _WORTH_SAYING:
        return ()
    how = "edges = true" if specimen.gyration_m is not None else "edges = true, with the discs' diameters"
    return (
        f"what the discs' free edges give way makes G' up to {100 * missing:.2g} % higher: allowed for, not "
        f"counted ([shear-pair] {how})",
    )


def _beyond_edges(pair: ShearPair) -> tuple[str, ...]:
    """Where discs are thicker than what is counted of their edges was found right for."""
    thick = pair.softer_by_edges / EDGE
    if thick <= _AS_WIDE:
        return ()
    return (
        f"the discs are {thick:.2g} times as thick as r_o - r_i: what their free edges give way is counted "
        "as of thinner ones, and G' may be low (of full discs by 4 % at 1.5 times, by 9 % at 2); take "
        "thinner discs",
    )


def remarks_on_holder(sweep: Sweep, specimen: AnySpecimen) -> tuple[str, ...]:
    """Where pads are so stiff, by the mass and its resonance, that what holds them gives way beside them."""
    if not isinstance(specimen, ShearPair) or specimen.drive != "base" or specimen.exact:
        return ()
    # Of a mass that moves with its base the acceleration is largest there, beside its base the displacement.
    per_velocity = sweep.omega if specimen.reads == "absolute" else 1 / sweep.omega
    f = sweep.frequency_hz
    at = f[np.argmax(np.abs(sweep.response_m_s) / sweep.commanded_m_s2 * per_velocity)]
    if at == f.min():
        # The resonance lies below all that was measured.
        return ()
    share = specimen.mass_kg * (2 * np.pi * float(at)) ** 2 / _HOLDER_N_M
    if share < _GIVES_WAY:
        return ()
    return (
        f"the pads are stiff ({share * _HOLDER_N_M / 1e6:.2g} N/um by the mass and its resonance): a holder, "
        f"with adherends and screws, of {_HOLDER_N_M / 1e6:.0f} N/um in series leaves G' and the loss factor "
        f"{100 * share:.2g} % low there, more above, and no effect of the catalogue shows it; put a block of "
        "metal in the pads' place to see how far it gives way, or take smaller or thicker pads",
    )


def remarks_on_strain(files: Sequence[File]) -> tuple[str, ...]:
    """Which strains pads had whose law is of one level: there softening is not told from another law."""
    pairs = [(file.sweep, s) for file in files if isinstance(s := file.specimen, ShearPair)]
    driven = [pair for pair in pairs if pair[1].drive == "base" and not pair[1].exact]
    if not driven or count_of_levels(np.concatenate([s.level_m_s2 for s, _ in driven])) > 1:
        return ()
    strain = np.concatenate([_strain(sweep, pair) for sweep, pair in driven])
    least, most = (f"{100 * v:.2g}" for v in (strain.min(), strain.max()))
    return (
        f"one level: the law is that of the strains it was measured at ({least} to {most} % in the pads), "
        "and softening with strain is not told from another law; a second level, three times lower, tells",
    )


def _strain(sweep: Sweep, pair: ShearPair) -> Array:
    """Amplitude of the pads' shear strain. Shape (points,)."""
    omega = sweep.omega
    base = sweep.commanded_m_s2 / (1j * omega) if pair.reads == "absolute" else 0.0
    at_command = np.abs(sweep.response_m_s - base) / (omega * pair.core.thickness_m)
    return np.asarray(at_command * sweep.level_m_s2 / sweep.commanded_m_s2)


def remarks_on_one_specimen(files: Sequence[File], rms_percent: float) -> tuple[str, ...]:
    """Where files share one pair or beam and one law leaves `rms_percent` of what they read."""
    one = files[0].specimen
    shared = len(files) > 1 and all(f.specimen == one for f in files) and isinstance(one, Beam | ShearPair)
    if not shared or rms_percent < _OFF_PERCENT:
        return ()
    differ = "mass" if isinstance(one, ShearPair) else "length or layers"
    return (
        f"all files are taken to be of the one {one.kind} that is stated: where they differ in {differ}, "
        "expected a --specimen for each",
    )


def remarks_on_scale(specimen: AnySpecimen, law: CoreLaw, frequency_hz: Array) -> tuple[str, ...]:
    """Where a pair's modulus is far from where its file begins: it scales with each of its numbers, unseen.

    `frequency_hz` of shape (points,).
    """
    if not isinstance(specimen, ShearPair):
        return ()
    omega = 2 * np.pi * frequency_hz
    if not CORE_PA[0] <= np.median(law.modulus(omega).real) <= CORE_PA[1]:
        # No core at all has it: that is asked already.
        return ()
    ratio = float(np.median(np.abs(law.modulus(omega) / specimen.core.law.modulus(omega))))
    if 1 / _FAR < ratio < _FAR:
        return ()
    return (
        f"the modulus is {ratio:.2g} times that of the law it begins with: if that is not expected, is the "
        "frequency in Hz, the mass in kg, area and thickness in mm, and how many discs are there?",
    )
