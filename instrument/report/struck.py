"""Blows on the treated plate: how it was held, the hits, and the mobility that went into the diagnosis."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from instrument.report.blocks import Block, FigureBlock, ReportSection, Sentence
from instrument.report.hammer import hits_table
from instrument.results.drawing import DATA, from_zero, label, panels
from instrument.session.contents import Contents
from instrument.stream.derived import StruckFound


def struck_sections(contents: Contents) -> list[ReportSection]:
    """None where it was not struck."""
    if not contents.struck and not contents.struck_hits:
        return []
    blocks: list[Block] = []
    for one in contents.struck:
        blocks += [Sentence(_words(one)), FigureBlock(_figure(one), _CAPTION)]
        blocks += [Sentence(f"{remark[:1].upper()}{remark[1:]}.", "warning") for remark in one.remarks]
    if not contents.struck:
        blocks.append(Sentence("The blows were not ended: they gave no mobility.", "warning"))
    if contents.struck_hits:
        blocks.append(hits_table(contents.struck_hits))
    return [ReportSection(f"Damped {contents.specimen.kind} struck", tuple(blocks))]


_CAPTION = "Mobility of the damped plate at the lines that went into the diagnosis, ± one standard deviation"


def _words(one: StruckFound) -> str:
    (x, y), (length, width) = one.struck_mm, one.size_mm
    held = f"Hung free, {length:g} by {width:g} mm" if one.held == "free" else "In its clamp"
    at = one.spot_mm
    spot = "where the laser was" if at is None else f"at ({at[0]:.0f}, {at[1]:.0f}) mm"
    lines = f"{len(one.frequency_hz)} lines about {len(set(one.segment))} resonances"
    return f"{held}: struck at ({x:.0f}, {y:.0f}) mm, read {spot}; {one.hits} hits averaged, {lines}."


def _figure(one: StruckFound) -> Figure:
    """Magnitude above phase."""
    f, std = np.array(one.frequency_hz), np.array(one.mobility_std_m_s_n)
    H = np.array(one.mobility_re_m_s_n) + 1j * np.array(one.mobility_im_m_s_n)
    figure, ((above,), (below,)) = panels(2, 1, 4.6)
    dots: dict[str, Any] = {"color": DATA, "fmt": ".", "markersize": 3, "elinewidth": 0.6}
    above.errorbar(f, np.abs(H), yerr=std, **dots)
    below.errorbar(f, np.degrees(np.angle(H)), yerr=np.degrees(std / np.abs(H)), **dots)
    from_zero(above, np.abs(H) + std)
    label(above, y="Mobility / (m/s/N)")
    label(below, x="Frequency / Hz", y="Phase / degree")
    return figure
