"""What blows on a treated plate gave, made up."""

from instrument.stream.derived import StruckFound

SIZE_MM = (330.2, 199.9)


def struck(held="free", mounting=0, **changes):
    """Two lines; hung free it is 30 mm longer than the published plate stands out of its clamp."""
    given = {"struck_mm": (285.0, 180.0), "spot_mm": (15.0, 20.0), "size_mm": SIZE_MM}
    if held == "clamped":
        given |= {"spot_mm": None, "size_mm": (300.2, 199.9)}
    lines = {"frequency_hz": (80.0, 81.0), "segment": (1, 1), "hits": 3}
    read = {
        "mobility_re_m_s_n": (0.1, 0.2),
        "mobility_im_m_s_n": (0.0, 0.1),
        "mobility_std_m_s_n": (1e-3, 2e-3),
    }
    return StruckFound(held, mounting=mounting, **{**given, **lines, **read, **changes})
