"""The instrument: what is measured, in which order, what it means and where it is kept.

It joins `drivers` and `fitting`, which do not know each other. Where to begin:

    cli/            the commands, one file each
    files/          files read and checked; what of them becomes a dataclass of `fitting`
    run/            a run: rig, plan, runner, live fit, live diagnosis; the same again from a recording
    stream/         everything that happens in one, as events
    session/        where it is kept
    models/         models of a specimen, kept on disk
    finding/, temperatures/       identifies and diagnoses with these models
    results/, report/, facts/     what is said of a result, shown, and written as JSON

ARCHITECTURE.md has all folders, in the order in which one may use another.
"""
