"""What a fit cannot explain, traced to an effect the plate model lacks.

Where to begin: `diagnose.py` (from a sweep to a verdict), `joint.py` (its first fit as an identification),
`thresholds.py` (what it decides by). A folder uses only those below it:

    verdict/     which explanations stand, what is in no catalogue, what is said of them
    search/      which effects are tried, alone and in pairs, and what each is worth
    checks/      whether a fit holds: what it leaves, whether it would leave such data, what it predicts
    inference/   law, stated numbers and effects fitted together, and how well each is known then
    several/     several files, spots and specimens under one law
    response/    what a sweep reads under a law, stated numbers and effects
    problem/     one set of data: what no candidate changes, and what model and instruments get wrong
"""
