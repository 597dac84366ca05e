"""How strong effects are that plates and beams hide alike: choices, to matter beside tolerances."""

AIR_KG_M3 = (1.1, 1.25)
"""Density of air: of a warm room high above the sea to a cold one beside it."""
MASS = (0.006, 0.02)
"""Of the specimen's mass, of something that sits on it: a small accelerometer, a label."""
LOOSE_MASS = (0.003, 0.012)
"""The same of a part on a spring of its own: near its frequency it does more than it weighs."""
LOOSE_NEAR = (0.0, 0.08)
"""How far its own frequency is from a resonance: it shows nearby alone."""
LOOSE_LOSS = (0.02, 0.1)
"""Its loss factor there: a clip to a drop of glue."""
LOOSE_POWER = (-0.3, 1.0)
"""Power of frequency that its loss goes with: 0 is structural, 1 viscous."""
CABLE_LOSS = (0.05, 0.4)
"""Loss factor of a cable at the first resonance: stiff wire to soft plastic."""
FRICTION_LOSS = (0.2, 0.6)
"""Loss factor of a root that rubs: less is lost beside the core's."""
ACROSS = (0.5, 2.0)
"""Springs of a root along one axis over those along another: contact is not alike in all directions."""
CLAMP_LINE_M = (1.5e-3, 4e-3)
"""Where a specimen bends from, beside the jaw's visible edge: five tolerances of a length and more."""
DEBONDED = (0.06, 0.16)
"""Width of a strip that has come loose, of the side that it lies across."""
LOOSENED = 0.985
"""Of the core's stiffness, that is lost where it holds to nothing: faces still touch."""
BOND_EDGE = (0.008, 0.025)
"""Over which the bond recovers, of the same side."""
DRIFT_K = (3.0, 7.0)
"""What a core warms by in the end: as much as a closed room does in a day."""
COOLS = 0.25
"""Of drifts: rigs mostly warm up."""
DRIFT_TIME = (0.3, 1.0)
"""Time constant over the duration of the sweep: a slower drift is straight, a faster one is over soon."""
ACTIVATION_J_MOL = (70e3, 130e3)
"""Of Arrhenius' shift: damping polymers above their transition."""
FIXTURE_FROM = 1.5
"""Lowest own frequency of a fixture over the first resonance: a softer one would be seen at once."""
FIXTURE_DAMPING = (0.01, 0.05)
"""Its damping ratio: bolted metal."""
FIXTURE_GAIN = (0.01, 0.05)
"""What the root moves by more than the reference: a sensor sits close to it."""
FIXTURE_PITCH = (0.005, 0.03)
"""Its pitch times the specimen's length, per acceleration of the reference."""
