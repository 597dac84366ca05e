"""The fitting: from a specimen and its readings to the core's law, its uncertainty, and what the model lacks.

Arrays and small frozen dataclasses in, the same out: no file, no screen, and no clock but one that times the
posterior. Where to begin:

    specimen.py, sweep.py   what is given: a stated specimen, measured points, in SI units
    plate.py, reduced.py    the plate's matrices, and the small model that is fitted instead
    structures/             beams and shear pairs, as matrices of the same equation
    laws/                   formulas for G*(omega), one file each
    identification/         a law from a sweep
    diagnosis/, effects/    what a fit cannot explain, and the causes that are tried
    tolerances.py, nuisances.py   stated numbers, and what they change as unknowns of a fit
    mode_tables/, temperature/    modes instead of sweeps; several temperatures
    planning/               what a measurement would teach

ARCHITECTURE.md has all of it.
"""
