"""Tables of modes of a sandwich beam, stated exactly, with noise that they state; the fit without effects."""

from dataclasses import replace

import numpy as np

from fitting.laws import LAWS
from fitting.laws.constant import ConstantModulus
from fitting.mode_tables.build import member_of
from fitting.mode_tables.explaining import Explaining
from fitting.mode_tables.fit import begin_modal, modal_fit_of, problem_of, start_of
from fitting.mode_tables.problem import ModalProblem
from fitting.mode_tables.table import ModalTable
from fitting.stated.layers import Core, Face
from fitting.structures.beam import Beam
from fitting.structures.small import system_of
from fitting.structures.small_modes import small_modes

LAW = ConstantModulus(3e6, 0.5)
FACE = Face(2e-3, 70e9, 0.3, 2700.0)
BEAM = Beam(
    *(0.4, 0.01, "clamped-free", FACE, FACE, Core(0.5e-3, 0.49, 1000.0, LAW)), held_width=True, exact=True
)
SOFT = LAWS["fractional-zener"](1.5e6, 3e7, 8e-5, 0.6)
STEEL = Face(1.5e-3, 205e9, 0.3, 7850.0)
KNOWN_NEARLY = Beam(
    *(0.18, 0.015, "clamped-free", STEEL, STEEL, Core(0.25e-3, 0.49, 1080.0, SOFT)),
    held_width=True,
    tolerances={"substrate_young": 0.007, "constraining_thickness": 0.005, "core_thickness": 0.03},
)
"""Its law may bend and its stated numbers may move."""


def read(true, count=6, seed=0, law=LAW):
    modes, rng = small_modes(true, law, count), np.random.default_rng(seed)
    f, eta = (np.array([getattr(m, name) for m in modes]) for name in ("frequency_hz", "loss_factor"))
    return ModalTable(
        np.arange(1.0, count + 1),
        f * (1 + 1e-3 * rng.standard_normal(count)),
        eta * (1 + 0.03 * rng.standard_normal(count)),
        1e-3 * f,
        0.03 * eta,
    )


def with_row(table, k, f=1.0, eta=1.0):
    """The table with the numbers of one row so many times what they are."""
    where = np.arange(len(table.mode)) == k
    return replace(
        table,
        frequency_hz=np.where(where, f, 1.0) * table.frequency_hz,
        loss_factor=np.where(where, eta, 1.0) * table.loss_factor,
    )


def nearly_read(seed=0):
    """Six modes of the beam that is known nearly, with errors that are stated."""
    return replace(read(KNOWN_NEARLY, seed=seed, law=SOFT), read="model")


def poles_of(beam, count):
    """With its law in the complex plane: what a perfect curve fit finds. Frequencies, losses."""
    system, law, found = system_of(beam, beam.parts()), beam.core.law, []
    for mode in small_modes(beam, law, count):
        p = 2 * np.pi * mode.frequency_hz * (1 + 0.5j * mode.loss_factor)
        y = np.array(mode.shape, complex)
        for _ in range(30):
            K = system.K_0 + complex(law.modulus(np.array([p]))[0]) * system.K_1
            y = np.linalg.solve(K - p * p * (1 + 1e-7) * system.M, system.M @ y)
            y /= np.sqrt(y @ (system.M @ y))
            p = np.sqrt(y @ (K @ y))
        found.append((abs(p) / (2 * np.pi), 2 * p.imag / abs(p)))
    return np.array(found).T


def begun(*tables):
    beams = [BEAM] * len(tables)
    problem = ModalProblem.of([member_of(t, b) for t, b in zip(tables, beams, strict=True)])
    return Explaining(begin_modal(problem, start_of(tables, beams)))


def fit_modes(tables, specimens):
    """The law of all tables, without any effect."""
    return modal_fit_of(begin_modal(problem_of(tables, specimens), start_of(tables, specimens)))
