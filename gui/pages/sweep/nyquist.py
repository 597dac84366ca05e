"""Real against imaginary part, equal axes."""

import numpy as np
from PySide6.QtCore import Signal
from PySide6.QtWidgets import QVBoxLayout, QWidget

from gui.pages.sweep.panes import CHOSEN, SIGNS, Key, Pointed, beside_key, beside_look, keyed
from gui.pages.sweep.seen import PaneContents
from gui.plots import Axis
from gui.style.theme import Role


class NyquistPane(QWidget):
    """The response in its plane."""

    chosen = Signal(int)

    def __init__(self) -> None:
        super().__init__()
        self.plot, self.key = Pointed(Axis("Re"), Axis("Im"), legend=False), Key()
        self.plot.setAspectLocked(True)
        self.plot.chosen.connect(self.chosen)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(keyed(self.key, self.plot))

    def show_seen(self, seen: PaneContents) -> None:
        """Draw."""
        label = "v/a" if seen.way.quantity == "ratio" else "v at its level"
        self.plot.show_axes(Axis(f"Re {label}", seen.way.unit), Axis(f"Im {label}", seen.way.unit))
        names = self._draw_model(seen)
        response, groups = seen.shown, seen.points.groups(seen.wanted)
        model: list[tuple[str, Role, str]] = [(name, "model", "\u2500") for name in names]
        drawn: list[tuple[str, Role, str]] = [(g.name, g.role, SIGNS[g.symbol]) for g in groups]
        keys = beside_key(one.name for one in seen.beside)
        others = [key for key, one in zip(keys, seen.beside, strict=True) if one.has_phase]
        self.key.show_key([*model, *drawn, *others])
        for group in groups:
            z = response[group.index]
            self.plot.show_points(group, z.real, z.imag)
            names.append(group.name)
        for k, one in enumerate(seen.beside):
            z = (one.over_base_s * seen.way.factor(one.level_m_s2))[one.inside(seen.band_hz)]
            if one.has_phase:
                self.plot.points(one.name, z.real, z.imag, **beside_look(k))
                names.append(one.name)
        self.plot.keep((*names, CHOSEN))
        at = response[seen.chosen] if seen.chosen is not None else None
        self.plot.point_out(at.real if at is not None else None, at.imag if at is not None else None)

    def whole(self) -> None:
        """All there is in view."""
        self.plot.enableAutoRange()

    def _draw_model(self, seen: PaneContents) -> list[str]:
        stretches = seen.stretches(seen.curve)
        if not stretches:
            return []
        gap = np.array([complex(np.nan, np.nan)])
        drawn = [f * s.over_base_s for s in stretches for f in seen.way.factor(seen.levels(s.segment))]
        z = np.concatenate([part for one in drawn for part in (one, gap)])
        name = f"model, {seen.fit_name}{seen.whose}"
        self.plot.line(name, z.real, z.imag)
        return [name]
