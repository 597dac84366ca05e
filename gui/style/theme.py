"""Colours and type size of the whole window; the only file that knows a colour.

The colours of data are those of Okabe and Ito, told apart with any colour vision. No meaning is carried by
colour alone: a page that colours by quality also changes the symbol.
"""

from dataclasses import dataclass
from typing import Literal

from PySide6.QtCore import QObject, Qt
from PySide6.QtGui import QColor, QGuiApplication, QPalette, QPixmapCache
from PySide6.QtWidgets import QApplication

from gui.style.style_sheet import style_sheet

Mode = Literal["system", "light", "dark"]
Role = Literal[
    "data", "model", "second", "third", "fourth", "good", "fair", "bad", "text", "faint", "grid", "base"
]  # fmt: skip
SCALES = (0.8, 0.9, 1.0, 1.15, 1.3, 1.5, 1.75, 2.0)
"""Type sizes to choose from."""
_DRAWINGS_KB = 1024


@dataclass(frozen=True)
class Theme:
    """One set of colours, `#rrggbb`."""

    window: str
    base: str
    """Of plots, lists and fields."""
    button: str
    text: str
    faint: str
    grid: str
    accent: str
    """The one colour of what can be done or is chosen."""
    accent_text: str
    """Upon it."""
    data: str
    model: str
    second: str
    third: str
    fourth: str
    good: str
    fair: str
    bad: str
    stop: str
    stop_text: str
    note: str
    """Behind a message."""

    def color(self, role: Role, alpha: float = 1.0) -> QColor:
        """Of a role, `alpha` 0 (not seen) to 1."""
        color = QColor(getattr(self, role))
        color.setAlphaF(alpha)
        return color

    def palette(self) -> QPalette:
        """The colours of every widget."""
        roles = QPalette.ColorRole
        palette = QPalette()
        for role, color in {
            roles.Window: self.window,
            roles.WindowText: self.text,
            roles.Base: self.base,
            roles.AlternateBase: self.window,
            roles.Text: self.text,
            roles.PlaceholderText: self.faint,
            roles.Button: self.button,
            roles.ButtonText: self.text,
            roles.ToolTipBase: self.note,
            roles.ToolTipText: self.text,
            roles.Highlight: self.accent,
            roles.HighlightedText: self.accent_text,
            roles.Light: self.button,
            roles.Midlight: self.button,
            roles.Mid: self.grid,
            roles.Dark: self.grid,
            roles.Shadow: self.grid,
            roles.Link: self.accent,
            roles.Accent: self.accent,
        }.items():
            palette.setColor(role, QColor(color))
        for role in (roles.WindowText, roles.Text, roles.ButtonText):
            palette.setColor(QPalette.ColorGroup.Disabled, role, QColor(self.faint))
        palette.setColor(QPalette.ColorGroup.Disabled, roles.Button, QColor(self.window))
        return palette


LIGHT = Theme(
    window="#f4f5f7", base="#ffffff", button="#ffffff", text="#1b1d21", faint="#5a616b", grid="#cdd2d8",
    accent="#0067a3", accent_text="#ffffff", data="#006ba8", model="#b54700", second="#00734f",
    third="#98406f", fourth="#755800", good="#00734f", fair="#8f5600", bad="#b3261e",
    stop="#b00c12", stop_text="#ffffff",
    note="#fff4d6",
)  # fmt: skip
DARK = Theme(
    window="#1e2125", base="#16181b", button="#2b2f35", text="#e8eaed", faint="#a3aab3", grid="#434951",
    accent="#56b4e9", accent_text="#0b0d10", data="#56b4e9", model="#f0a13c", second="#3cc79d",
    third="#e39ac5", fourth="#e0d34a", good="#3cc79d", fair="#f0b429", bad="#ff8a7a",
    stop="#c4161c", stop_text="#ffffff",
    note="#352e17",
)  # fmt: skip


def current_theme() -> Theme:
    """The one the window is shown in. Ask again on `QEvent.Type.PaletteChange`."""
    window = QGuiApplication.palette().color(QPalette.ColorRole.Window)
    return DARK if window.lightness() < 128 else LIGHT


class Appearance(QObject):
    """Light, dark or as the system has it; and the size of type.

    Not `dressed`, widgets have the toolkit's own edges, and a window is made in half the time.
    """

    def __init__(
        self, application: QApplication, mode: Mode = "system", scale: float = 1.0, *, dressed: bool = True
    ) -> None:
        super().__init__(application)
        self._application, self._dressed = application, dressed
        application.setStyle("Fusion")
        # Drawings are kept by palette, and every new widget's is another one: few are ever used again.
        QPixmapCache.setCacheLimit(_DRAWINGS_KB)
        self._points = application.font().pointSizeF()
        self.mode: Mode = mode
        self.scale = scale
        self._held = self._waiting = False
        application.styleHints().colorSchemeChanged.connect(self._system_changed)
        self.choose(mode)
        self.resize(scale)

    def choose(self, mode: Mode) -> None:
        """Show everything in this mode."""
        self.mode = mode
        self._tell_system()
        self._show()

    def hold(self, held: bool) -> None:
        """While held, what is chosen waits: to show it takes a second or two, and STOP would wait too."""
        if held == self._held:
            return
        self._held = held
        if not held and self._waiting:
            self._waiting = False
            self._tell_system()
            self.resize(self.scale)

    @property
    def waiting(self) -> bool:
        """Whether something was chosen that is not shown yet."""
        return self._waiting

    def resize(self, scale: float) -> None:
        """Type so many times its usual size."""
        self.scale = scale
        if self._held:
            self._waiting = True
            return
        font = self._application.font()
        font.setPointSizeF(self._points * scale)
        # A style sheet keeps the type of widgets that are there: it is taken off meanwhile.
        self._application.setStyleSheet("")
        self._application.setFont(font)
        self._show()

    def _tell_system(self) -> None:
        """Its frames and file dialogs follow; not every system listens."""
        schemes = {"light": Qt.ColorScheme.Light, "dark": Qt.ColorScheme.Dark}
        if not self._held:
            self._application.styleHints().setColorScheme(schemes.get(self.mode, Qt.ColorScheme.Unknown))

    def _system_changed(self) -> None:
        self._show()

    def _show(self) -> None:
        if self._held:
            self._waiting = True
            return
        system = self._application.styleHints().colorScheme() == Qt.ColorScheme.Dark
        dark = self.mode == "dark" or (self.mode == "system" and system)
        theme = DARK if dark else LIGHT
        self._application.setPalette(theme.palette())
        self._application.setStyleSheet(style_sheet(vars(theme)) if self._dressed else "")
