"""What each command does, in a line: so that `viscorig --help` need not load them. A test compares."""

SUMMARIES = {
    "demo": "A whole experiment on a simulated rig, and the published ZN_1 case.",
    "new": "A commented file of KIND to start from, valid as it stands, in PATH or KIND.toml here.",
    "plan": "Steps, level and spot for SPECIMEN.toml and a wanted uncertainty, and what they could not tell.",
    "sensors": "The sensors of SENSORS.toml, and whose calibration has expired or soon will.",
    "doctor": "Whether the installation is in order and, with RIG.toml, whether its instruments answer.",
    "check": "Everything wrong with EXPERIMENT.toml and the files it names; then a dry run on the model.",
    "run": "The whole EXPERIMENT.toml on the rig it names: hammer test, sweep, live identification, session.",
    "hammer": "The bare plate's hammer test of EXPERIMENT.toml: natural frequencies and damping ratios.",
    "sweep": "The stepped sine of EXPERIMENT.toml, identified as it goes.",
    "simulate": "Stand up the instruments of RIG.toml's [simulation] until interrupted.",
    "replay": "Run SESSION.h5 again: every derived event is computed from the recorded samples and compared.",
    "recover": "Put together the session of a run that was killed, from its FOLDER (NAME.running).",
    "modes": "Natural frequencies and modal loss factors of SPECIMEN.toml.",
    "predict": (
        "Velocity at the pickup of SPECIMEN.toml under its base acceleration, as phasors and amplitudes."
    ),
    "damping": "Natural frequencies and damping ratios of impact RECORDs (averaged) or of one FRF.",
    "identify": "The core's complex shear modulus from DATA, with its uncertainty.",
    "diagnose": (
        "What the fit of DATA cannot explain, traced to a physical effect, with the error before and after."
    ),
    "batch": (
        "A law for each of FILES: sessions (.h5), sweeps, or one table with the columns data and specimen."
    ),
    "report": "SESSION.h5 as one self-contained HTML page: figures inside it, nothing fetched from anywhere.",
    "card": "The law in FOUND as a material card: SESSION.h5, or the JSON of `identify` or `diagnose`.",
    "compare": (
        "Where the laws in FILES differ beyond their joint uncertainties: two or more, each with each."
    ),
    "export": "SESSION.h5 as universal files, CSV or MATLAB: sweep, hits, damping.",
    "import": "FILE (.uff, .unv, .mat, .lvm, or text) as CSV for 'viscorig identify' and 'viscorig damping'.",
    "bench": (
        "Time the reduced model against direct solves and the paper's procedure, in this run on this machine."
    ),
    "gui": "The window, with SESSION.h5 where one is given.",
}
