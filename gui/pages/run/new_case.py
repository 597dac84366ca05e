"""A new experiment on the simulated rig: where, and what its plate hides."""

from pathlib import Path

from PySide6.QtWidgets import (
    QComboBox,
    QDialog,
    QDialogButtonBox,
    QFormLayout,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QSpinBox,
    QWidget,
)

from gui.asking import ask_folder
from gui.widgets import button
from instrument.errors import BadInput
from instrument.simulated_case import DEFAULT_EFFECT, EFFECTS, FILES, chosen_effect, write_case


class NewCase(QDialog):
    """Asks; `write` does it."""

    def __init__(self, folder: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("New simulated experiment")
        self.folder = QLineEdit(str(folder))
        self.folder.setMinimumWidth(360)
        browse = button("", "Choose a folder", "open")
        browse.clicked.connect(self._browse)
        self.effect = QComboBox()
        self.effect.addItems(["random", "none", *EFFECTS])
        self.effect.setCurrentText(DEFAULT_EFFECT)
        self.seed = QSpinBox()
        self.seed.setRange(0, 10**9)
        self.seed.setValue(1)
        self.seed.setToolTip("Of the noise, and of the random choice")
        self.buttons = QDialogButtonBox(
            QDialogButtonBox.StandardButton.Ok | QDialogButtonBox.StandardButton.Cancel
        )
        self.buttons.accepted.connect(self.accept)
        self.buttons.rejected.connect(self.reject)
        row = QHBoxLayout()
        row.addWidget(self.folder, 1)
        row.addWidget(browse)
        said = QLabel(
            "The published plate behind simulated instruments. What its plate hides stays in the rig file: "
            "neither the fit nor the session is told."
        )
        said.setWordWrap(True)
        form = QFormLayout(self)
        form.addRow(said)
        form.addRow("Folder", row)
        form.addRow("Hidden effect", self.effect)
        form.addRow("Seed", self.seed)
        form.addRow(self.buttons)

    def order(self) -> tuple[Path, str, int]:
        """Folder, effect and seed."""
        return Path(self.folder.text()).expanduser(), self.effect.currentText(), self.seed.value()

    def _browse(self) -> None:
        ask_folder(self, "Folder", self.folder.text(), self._chosen)

    def _chosen(self, folder: Path) -> None:
        self.folder.setText(str(folder))


def write(folder: Path, effect: str, seed: int) -> Path:
    """The files; the experiment's path. Raises `BadInput`, also where there are such files already."""
    there = [name for name in FILES if (folder / name).exists()]
    if there:
        raise BadInput(f"{folder / there[0]}: is there already: choose another folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: {error.strerror or error}") from None
    return write_case(folder, seed=seed, effect=chosen_effect(effect, seed))
