"""A new experiment: on which rig, where, and what a simulated plate hides."""

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

from fitting.specimen import Kind
from gui.widgets.asking import ask_folder
from gui.widgets.basic import button
from instrument.errors import BadInput, system_words
from instrument.files.new_file import EXPERIMENT, SPECIMENS, write_real
from instrument.simulated_case import DEFAULT_EFFECT, EFFECTS, FILES, chosen_effect, write_case

SIMULATED, REAL = "simulated instruments", "real instruments"
_SAID = {
    SIMULATED: "The published plate behind simulated instruments. What its plate hides stays in the rig "
    "file: neither the fit nor the session is told.",
    REAL: "Commented files for a specimen on instruments of your own: put addresses, sensors and sizes in, "
    "then Check. Nothing is connected before Start.",
}


class NewCase(QDialog):
    """Asks; `write` does it."""

    def __init__(self, folder: Path, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle("New experiment")
        self.rig = QComboBox()
        self.rig.addItems(list(_SAID))
        self.rig.currentTextChanged.connect(self._rig_chosen)
        self.folder = QLineEdit(str(folder))
        self.folder.setMinimumWidth(360)
        browse = button("", "Choose a folder", "open")
        browse.clicked.connect(self._browse)
        self.specimen = QComboBox()
        for kind in SPECIMENS:
            self.specimen.addItem(kind.replace("-", " "), kind)
        self.specimen.setToolTip("A simulated rig begins with the published plate")
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
        self.said = QLabel()
        self.said.setWordWrap(True)
        self.said.setMinimumHeight(3 * self.fontMetrics().lineSpacing())
        form = QFormLayout(self)
        form.addRow("Rig", self.rig)
        form.addRow(self.said)
        form.addRow("Folder", row)
        form.addRow("Specimen", self.specimen)
        form.addRow("Hidden effect", self.effect)
        form.addRow("Seed", self.seed)
        form.addRow(self.buttons)
        self._rig_chosen()

    def order(self) -> tuple[Path, str | None, int, Kind]:
        """Folder, effect, seed and kind of specimen; no effect for a real rig."""
        effect = self.effect.currentText() if self.rig.currentText() == SIMULATED else None
        kind: Kind = self.specimen.currentData()
        return Path(self.folder.text()).expanduser(), effect, self.seed.value(), kind

    def _rig_chosen(self) -> None:
        self.said.setText(_SAID[self.rig.currentText()])
        simulated = self.rig.currentText() == SIMULATED
        self.specimen.setEnabled(not simulated)
        if simulated:
            self.specimen.setCurrentIndex(0)
        for one in (self.effect, self.seed):
            one.setEnabled(simulated)

    def _browse(self) -> None:
        ask_folder(self, "Folder", self.folder.text(), self._chosen)

    def _chosen(self, folder: Path) -> None:
        self.folder.setText(str(folder))


def write(folder: Path, effect: str | None, seed: int, specimen: Kind = "plate") -> Path:
    """The files; the experiment's path. Raises `BadInput`, also where there are such files already.

    Without an `effect` they are of a real rig and such a `specimen`: commented templates, to be filled in.
    """
    there = [name for name in (*FILES, *EXPERIMENT) if (folder / name).exists()]
    if there:
        raise BadInput(f"{folder / there[0]}: is there already: choose another folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise BadInput(f"{folder}: {system_words(error)}") from None
    if effect is None:
        return write_real(folder, specimen)
    return write_case(folder, seed=seed, effect=chosen_effect(effect, seed))
