"""What an experiment and its rig say."""

from mistakes.kinds import Mistake, text


def experiment(name: str, old: str, new: str, said: str, *, sure: bool = False) -> Mistake:
    """In the experiment's file; `sure`: beyond what it may hold at all."""
    return text(name, "experiment.toml", old, new, "check experiment.toml", said, plausibility=not sure)


def rig(
    name: str, old: str, new: str, said: str, command: str = "check experiment.toml", *, sure: bool = False
) -> Mistake:
    """In the rig's."""
    return text(name, "rig.toml", old, new, command, said, plausibility=not sure)


RIG = [
    experiment(
        "segment upside down",
        "low_hz = 235.0\nhigh_hz = 295.0",
        "low_hz = 295.0\nhigh_hz = 235.0",
        "low_hz = 295 is not below",
        sure=True,
    ),
    experiment("no hits", "hits = 4", "hits = 0", "hammer.hits", sure=True),
    experiment("hit beside it", "= 285.0", "= 385.0", "off the plate", sure=True),
    experiment("level in m/s2", "level_g = 1.0", "level_g = 9.81", "limit 50", sure=True),
    experiment("hit in m", "= 285.0", "= 0.285", "hit_x_mm.*in m"),
    experiment("band upside down", "[10.0, 550.0]", "[550.0, 10.0]", "lower frequency first", sure=True),
    experiment("band in kHz", "[10.0, 550.0]", "[0.01, 0.55]", "in kHz"),
    experiment("torque in N mm", "torque_n_m = 25.0", "torque_n_m = 25000.0", "in N mm"),
    rig("sensitivity in V", "= 10.0 ", "= 0.01 ", "base.*in V"),
    rig("sensitivity per g", "= 10.0 ", "= 1000.0 ", "mV per g"),
    rig("hammer per kN", "= 20.0 ", "= 20000.0 ", "mV per kN", "run experiment.toml"),
    rig("limit in mm/s", "= 1.0\ntravel", "= 1000.0\ntravel", "in mm/s"),
    rig("travel in m", "travel_mm = 5.0", "travel_mm = 0.005", "in m"),
    rig("drive in mV", "drive_v = 5.0", "drive_v = 5000.0", "in mV"),
    rig("sensor in kg", "mass_g = 0.6", "mass_g = 0.0006", "in kg"),
    rig("one input twice", "input = 2", "input = 1", "both base and", sure=True),
    rig("rate of a rig in kHz", "= 8192.0", "= 8.192", "sample_rate_hz", sure=True),
]
