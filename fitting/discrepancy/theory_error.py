"""How far the layer-wise plate is from exact elasticity, for one specimen and its band.

Inside a plate the error of a theory depends on the wavelength, not on the edges that select it: at each
frequency the wave at which the layer-wise plate resonates is put to the exact theory of the same layers,

    delta = 1/2 ln(lambda_exact / lambda_layerwise),  lambda = omega^2(k, G) at fixed k and G

Both theories take a patched plate as treated all over, and an orthotropic face as an isotropic one of the
mean of its moduli: what is wanted is how far they are from each other. Re delta is the relative shift of a
resonance, 2 Im delta that of its loss factor in absolute terms. On simply supported edges this is all there
is; clamped and free edges add `EDGE_FREQUENCY` and `EDGE_LOSS`.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import ArrayLike

from fitting.arrays import Array, Complex
from fitting.discrepancy.exact_layers import ElasticLayer, exact_lambda
from fitting.discrepancy.layer_theory import layerwise_lambda, wavenumber
from fitting.errors import OutsideModel
from fitting.laws import CoreLaw
from fitting.specimen import PlateSpecimen
from fitting.stated.layers import Face, Glue, as_isotropic

FREQUENCY_LIMIT = 5e-3
"""Largest error of a resonance. A tenth to a third of the stiffness is the core's: G' is then 3 to 10 % off,
more than any specimen's other tolerances make it."""
LOSS_LIMIT = 0.05
"""Largest relative error of a modal loss factor: it goes into the core's loss factor one to one."""

EDGE_FREQUENCY, EDGE_LOSS = 2.0, 10.0
"""Relative errors that clamped and free edges add, in units of (thickness/shorter side)^2.

From cantilever strips 300 mm long in plane strain, solid elements against layer-wise, up to five modes: the
published section, cores of 0.03 to 5 MPa, a core of 5 mm, a substrate of 20 mm. The largest were 2.1 and 8.
"""

COUNTED_WITHIN = 0.25
"""Of what a beam's core does that stretches across its thickness: where it is counted (`beam_apart`), solids
are so far off at most, of a soft thick core under a thin face."""

GLUE_POISSON = 0.4
"""Of an adhesive, where its shear modulus is stated alone; the error hardly depends on it."""

_QUICK_ORDER = 3
"""Parabolic shear in each layer: which assumption is to blame shows in it as it does in ORDER."""


@dataclass(frozen=True)
class Assumption:
    """What the layer-wise theory assumes: how its failure reads, and what to do."""

    name: str
    failure: str
    remedy: str


FACES_TOGETHER = Assumption(
    "faces together",
    "the faces no longer move together, the core stretches across its thickness",
    "a thinner or stiffer core, or a band that ends lower",
)
FACES_STIFF_IN_SHEAR = Assumption(
    "faces stiff in shear",
    "the faces shear across their thickness",
    "thinner faces, or a band that ends lower",
)
NO_ROTARY_INERTIA = Assumption(
    "no rotary inertia", "the layers' rotation takes part in the inertia", "a band that ends lower"
)
CORE_LINEAR = Assumption(
    "core linear",
    "the core no longer follows its faces linearly",
    "a thinner or stiffer core, or a band that ends lower",
)


@dataclass(frozen=True)
class TheoryError:
    """The layer-wise plate against exact elasticity, at each frequency. Arrays of shape (frequencies,)."""

    frequency_hz: Array
    wavenumber: Array
    """Of the wave at which the layer-wise plate resonates there, 1/m."""
    frequency_error: Array
    """(layer-wise - exact)/exact resonance at that wave."""
    loss_factor: Array
    """Modal loss factor by exact elasticity."""
    loss_factor_error: Array
    """(layer-wise - exact)/exact modal loss factor."""
    delta: Complex
    """1/2 ln(lambda_exact/lambda_layerwise), of the opposite sign."""
    blamed: Callable[[], Assumption]
    """`worst_assumption`: only a refusal names it, and to find it takes as long as all the rest."""

    @property
    def worst_assumption(self) -> Assumption:
        """What fails most at the frequency where the theory is worst."""
        return self.blamed()

    @property
    def excess(self) -> Array:
        """Error over its limit, the larger of the two at each frequency. Shape (frequencies,)."""
        return _excess(self.frequency_error, self.loss_factor_error)

    @property
    def acceptable(self) -> bool:
        """Whether both errors keep their limits at all frequencies."""
        return bool(np.all(self.excess <= 1))


def theory_error(specimen: PlateSpecimen, frequency_hz: ArrayLike, G: ArrayLike = 0.0) -> TheoryError:
    """The error at frequencies in Hz where the core has the complex moduli `G` in Pa.

    `G` is one number or one for each frequency; a bare plate takes none.
    """
    f = np.atleast_1d(np.asarray(frequency_hz, dtype=float))
    G = np.broadcast_to(np.asarray(G, dtype=complex), f.shape)
    k = wavenumber(specimen, 2 * np.pi * f, G)
    layerwise, exact = layerwise_lambda(specimen, k, G), exact_lambda(stack(specimen, G), k)
    frequency_error, loss_error = _errors(layerwise, exact)
    worst = int(np.argmax(_excess(frequency_error, loss_error)))
    return TheoryError(
        frequency_hz=f,
        wavenumber=k,
        frequency_error=frequency_error,
        loss_factor=exact.imag / exact.real,
        loss_factor_error=loss_error,
        delta=np.asarray(np.log(exact / layerwise) / 2, dtype=complex),
        blamed=partial(_worst_assumption, specimen, k[[worst]], G[[worst]]),
    )


def thickness_error(specimen: PlateSpecimen, wavenumber: Array, G: Complex) -> tuple[Array, Array]:
    """What comes of layers that stretch across their thickness alone, all else exact: relative errors.

    Of the frequency and of the loss factor of waves (1/m), core moduli given. Shape (waves,) each.
    """
    return _errors(*_held_and_exact(specimen, wavenumber, G))


def _held_and_exact(specimen: PlateSpecimen, wavenumber: Array, G: Complex) -> tuple[Complex, Complex]:
    """Of waves whose layers do not stretch across their thickness, and of exact ones."""
    layers = stack(specimen, G)
    held = tuple(replace(x, stretches=False) for x in layers)
    return exact_lambda(held, wavenumber, _QUICK_ORDER), exact_lambda(layers, wavenumber, _QUICK_ORDER)


def check_beam_theory(layers: PlateSpecimen, law: CoreLaw, frequency_hz: ArrayLike) -> TheoryError:
    """The error over a band of a sandwich beam: how well it is known what a core does that stretches across.

    `layers` is a plate of the same ones. Raises `OutsideModel` where it is beyond a plate's limits at the
    lowest frequency: there waves are longest.
    """
    f = np.atleast_1d(np.asarray(frequency_hz, dtype=float))
    G = law.modulus(2 * np.pi * f)
    whole = theory_error(layers, f, G)
    held, exact = _held_and_exact(layers, whole.wavenumber, G)
    frequency, loss = _errors(held, exact)
    delta = np.asarray(np.log(exact / held) / 2, dtype=complex)
    error = replace(
        whole,
        frequency_error=COUNTED_WITHIN * frequency,
        loss_factor_error=COUNTED_WITHIN * loss,
        delta=np.asarray(COUNTED_WITHIN * delta, dtype=complex),
        blamed=_faces_together,
    )
    if error.excess[np.argmin(f)] > 1:
        raise OutsideModel(refusal(error, "beam"))
    return error


def _faces_together() -> Assumption:
    return FACES_TOGETHER


def check_theory(specimen: PlateSpecimen, law: CoreLaw | None, frequency_hz: ArrayLike) -> TheoryError:
    """The error over a band, where the layer-wise plate may be used; `law` None for a bare plate.

    Raises `OutsideModel` where a resonance or its loss factor would be further off than its limit.
    """
    f = np.atleast_1d(np.asarray(frequency_hz, dtype=float))
    error = theory_error(specimen, f, law.modulus(2 * np.pi * f) if law is not None else 0.0)
    if not error.acceptable:
        raise OutsideModel(refusal(error))
    return error


def stack(specimen: PlateSpecimen, G: ArrayLike = 0.0) -> tuple[ElasticLayer, ...]:
    """The specimen's layers from the substrate upwards, the core with modulus `G` in Pa."""
    b, c, v = specimen.substrate, specimen.constraining, specimen.core
    if v is None or c is None:
        return (_elastic(b),)
    core = ElasticLayer(v.thickness_m, G, v.poisson, v.density_kg_m3)
    # Of a glue it matters that it shears: beside the core it may lie on either side.
    above = (*(_of_glue(g) for g in v.glue[:1]), core, *(_of_glue(g) for g in v.glue[1:]), _elastic(c))
    below = above[::-1] if specimen.both_sides else ()
    return (*below, _elastic(b), *above)


def held_stack(specimen: PlateSpecimen, G: ArrayLike = 0.0) -> tuple[ElasticLayer, ...]:
    """The same layers with all assumptions held but that of a linear core."""
    stiff = set() if specimen.faces_shear else _faces(specimen)
    return tuple(
        replace(x, stretches=False, shears=i not in stiff, turns=False)
        for i, x in enumerate(stack(specimen, G))
    )


def _faces(specimen: PlateSpecimen) -> set[int]:
    """Places of the faces in the stack."""
    if specimen.core is None:
        return {0}
    step = 2 + len(specimen.core.glue)
    return {0, step, 2 * step} if specimen.both_sides else {0, step}


def _cores(specimen: PlateSpecimen) -> set[int]:
    """Places of the core, on one side or both."""
    if specimen.core is None:
        return set()
    above = 1 + min(len(specimen.core.glue), 1)
    if not specimen.both_sides:
        return {above}
    middle = 2 + len(specimen.core.glue)
    return {middle - above, middle + above}


def _of_glue(glue: Glue) -> ElasticLayer:
    shear = glue.shear_pa * (1 + 1j * glue.loss_factor)
    return ElasticLayer(glue.thickness_m, shear, GLUE_POISSON, glue.density_kg_m3)


def _elastic(face: Face) -> ElasticLayer:
    face = as_isotropic(face)
    shear = face.young_pa * (1 + 1j * face.loss_factor) / (2 * (1 + face.poisson))
    return ElasticLayer(face.thickness_m, shear, face.poisson, face.density_kg_m3)


def _errors(theory: Complex, exact: Complex) -> tuple[Array, Array]:
    """Relative errors of the frequency and of the loss factor, none where nothing is lost."""
    frequency = np.sqrt(theory.real / exact.real) - 1
    eta, eta_exact = theory.imag / theory.real, exact.imag / exact.real
    lossy = eta_exact != 0
    return frequency, np.where(lossy, eta / np.where(lossy, eta_exact, 1.0) - 1, 0.0)


def _excess(frequency_error: Array, loss_error: Array) -> Array:
    return np.maximum(np.abs(frequency_error) / FREQUENCY_LIMIT, np.abs(loss_error) / LOSS_LIMIT)


def _worst_assumption(specimen: PlateSpecimen, k: Array, G: Complex) -> Assumption:
    """The assumption that alone, held in an otherwise exact theory, makes the largest error."""
    layers = stack(specimen, G)
    exact = exact_lambda(layers, k, _QUICK_ORDER)

    def made_by(held: tuple[ElasticLayer, ...]) -> float:
        return float(_excess(*_errors(exact_lambda(held, k, _QUICK_ORDER), exact))[0])

    faces, core = _faces(specimen), _cores(specimen)
    made = {NO_ROTARY_INERTIA: made_by(tuple(replace(x, turns=False) for x in layers))}
    if not specimen.faces_shear:
        made[FACES_STIFF_IN_SHEAR] = made_by(
            tuple(replace(x, shears=False) if i in faces else x for i, x in enumerate(layers))
        )
    if specimen.core is not None:
        made[FACES_TOGETHER] = made_by(
            tuple(replace(x, stretches=False) if i in core else x for i, x in enumerate(layers))
        )
        # What is left once all others are held is how the core moves within.
        rigid = exact_lambda(held_stack(specimen, G), k, _QUICK_ORDER)
        made[CORE_LINEAR] = float(_excess(*_errors(layerwise_lambda(specimen, k, G), rigid))[0])
    return max(made, key=lambda assumption: made[assumption])


def refusal(error: TheoryError, of: str = "plate") -> str:
    """What is off where it is worst, why, and what to do; `of` says what theory's."""
    worst = int(np.argmax(error.excess))
    f, loss = error.frequency_error[worst], error.loss_factor_error[worst]
    if abs(loss) / LOSS_LIMIT >= abs(f) / FREQUENCY_LIMIT:
        what, number, limit = "modal loss factor", loss, LOSS_LIMIT
    else:
        what, number, limit = "resonance", f, FREQUENCY_LIMIT
    why = error.worst_assumption
    if of == "beam":
        within = f"{what} known within {100 * abs(number):.3g} %"
        return (
            f"beam theory at {error.frequency_hz[worst]:.4g} Hz: {within} "
            f"(limit {100 * limit:g} %), {why.failure}: expected {why.remedy}"
        )
    return (
        f"{of} theory at {error.frequency_hz[worst]:.4g} Hz: {what} {100 * abs(number):.3g} % "
        f"{'below' if number < 0 else 'above'} exact elasticity (limit {100 * limit:g} %), "
        f"{why.failure}: expected {why.remedy}"
    )
