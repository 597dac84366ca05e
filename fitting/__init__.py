"""The fitting: from a specimen and its readings to the core's law, its uncertainty, and what the model lacks.

Arrays and small frozen dataclasses in, the same out: no file, no screen, and no clock but one that times the
posterior. Where to begin:

    specimen.py, sweep.py       what is given: a stated specimen, measured points, in SI units
    stated/, data/              what a specimen is made of; which readings count, and how noisy they are
    laws/                       formulas for G*(omega), one file each
    plate/, dynamics/           the plate's matrices; its modes, damping and response in full
    reduced/, discrepancy/      the small model that is fitted instead; how wrong the plate's theory is
    structures/                 beams and shear pairs, as matrices of the same equation
    nuisances/                  stated numbers, and narrow resonances, as unknowns of a fit
    identification/             a law from a sweep, or G* without one
    diagnosis/, effects/        what a fit cannot explain, and the causes that are tried
    mode_tables/, temperature/  modes instead of sweeps; several temperatures
    planning/, depth/           what a measurement would teach; intervals beyond the linear errors
    modal/, numerics/           damping read off an FRF; mathematics that knows of no plate

ARCHITECTURE.md has all of it, and which folder uses which.
"""
