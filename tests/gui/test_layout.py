"""Nothing is cut and nothing overlaps on a small screen, on any page, in any tab."""

import pytest
from layout_faults import layout_faults, places
from PySide6.QtWidgets import QApplication, QCheckBox, QComboBox, QLabel, QLineEdit, QWidget

from gui.background.task import BackgroundCommand, BackgroundTask
from gui.style.icons import NAMES, icon
from gui.style.theme import DARK, LIGHT, Appearance
from gui.widgets.tables import Cell, ReadTable

ON = ("window", "base", "button", "note")
READ = ("text", "faint", "data", "model", "second", "third", "fourth", "good", "fair", "bad")
TICK = "#3d8fc4"
"""Of gui/style/tick.svg."""
LEAST_CONTRAST = 4.5
"""Of text, WCAG 2.2, 1.4.3."""


@pytest.fixture
def appearance(qapp):
    yield Appearance(qapp, "light")
    Appearance(qapp, "light", dressed=False)


def at_rest(window):
    QApplication.processEvents()
    return all(
        work.over for work in (*window.findChildren(BackgroundTask), *window.findChildren(BackgroundCommand))
    )


@pytest.mark.parametrize("size", [(1366, 768), pytest.param((1280, 720), marks=pytest.mark.long)])
def test_nothing_is_cut_and_nothing_overlaps(qtbot, opened, size):
    opened.resize(*size)
    faults = []
    for place in places(opened):
        qtbot.waitUntil(lambda: at_rest(opened), timeout=240_000)
        faults += [f"{place}: {fault}" for fault in layout_faults(opened)]
    assert faults == []


@pytest.mark.parametrize("mode", ["light", "dark"])
def test_a_field_and_a_choice_that_cannot_be_changed_look_so(qtbot, appearance, mode):
    appearance.choose(mode)

    def ground(made, *, enabled):
        qtbot.addWidget(made)
        made.setEnabled(enabled)
        made.resize(120, 24)
        return made.grab().toImage().pixelColor(60, 12).lightness()

    for kind in (QComboBox, QLineEdit):
        assert ground(kind(), enabled=True) != ground(kind(), enabled=False)


@pytest.mark.long
def test_type_half_as_large_again_cuts_nothing_on_a_small_screen(qtbot, opened, appearance):
    opened.resize(1366, 768)
    appearance.resize(1.5)
    faults = []
    for place in places(opened):
        qtbot.waitUntil(lambda: at_rest(opened), timeout=240_000)
        # Tabs that have no room are scrolled to.
        faults += [f"{place}: {fault}" for fault in layout_faults(opened) if "'tabs' has" not in fault]
    appearance.resize(1.0)
    assert faults == []
    assert (opened.width(), opened.height()) == (1366, 768)


@pytest.mark.pages("run")
def test_every_place_has_a_name_of_its_own(opened):
    found = list(places(opened))
    assert len(set(found)) == len(found)


def test_what_is_cut_or_overlaps_is_found(qtbot, appearance):
    whole = QWidget()
    qtbot.addWidget(whole)
    one, other = QLabel("far too long for its place", whole), QLabel("two", whole)
    one.setGeometry(0, 0, 40, 20)
    other.setGeometry(20, 0, 60, 20)
    whole.show()
    cut, upon = layout_faults(whole)[::-1]
    assert "far too long" in cut
    assert "lies upon" in upon


def test_what_ends_outside_its_window_is_found(qtbot, appearance):
    whole = QWidget()
    qtbot.addWidget(whole)
    QLabel("as wide as its words", whole).setGeometry(10, 0, 300, 20)
    whole.resize(100, 40)
    whole.show()
    (fault,) = layout_faults(whole)
    assert "ends at 309, 19 of 100, 40 px" in fault


def test_a_cell_broken_into_lines_is_whole_and_one_that_lacks_a_line_is_found(qtbot, appearance):
    table = ReadTable({"what": ""}, wide=(0,))
    qtbot.addWidget(table)
    table.setWordWrap(True)
    table.resize(160, 200)
    table.show_rows([[Cell("several words that are far too long for one line", left=True)]])
    table.show()
    table.resizeRowsToContents()
    assert layout_faults(table) == []
    table.setRowHeight(0, 20)
    (fault,) = layout_faults(table)
    assert "wants a row" in fault


def test_a_cells_text_begins_beside_its_stripe(qtbot, appearance):
    table = ReadTable({"what": "", "": ""})
    qtbot.addWidget(table)
    wide = []
    for edge in (None, "data"):
        table.show_rows([[Cell("spot_offset", edge=edge, left=True), Cell("")]])
        table.show()
        wide.append(table.columnWidth(0))
    assert wide[1] == wide[0] + 4


@pytest.mark.parametrize("theme", [LIGHT, DARK], ids=["light", "dark"])
def test_everything_written_can_be_read(theme):
    pairs = [(one, ground) for one in READ for ground in ON]
    pairs += [("accent_text", "accent"), ("stop_text", "stop")]
    weak = {
        (one, on): round(ratio, 2)
        for one, on in pairs
        if (ratio := contrast(getattr(theme, one), getattr(theme, on))) < LEAST_CONTRAST
    }
    assert weak == {}


def contrast(one: str, other: str) -> float:
    """WCAG 2.2's ratio of relative luminances."""
    low, high = sorted((luminance(one), luminance(other)))
    return (high + 0.05) / (low + 0.05)


def luminance(color: str) -> float:
    parts = [int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    red, green, blue = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in parts)
    return 0.2126 * red + 0.7152 * green + 0.0722 * blue


@pytest.mark.parametrize(("mode", "theme"), [("light", LIGHT), ("dark", DARK)], ids=["light", "dark"])
def test_every_sign_is_drawn_in_the_colours_of_its_button(appearance, mode, theme):
    appearance.choose(mode)
    assert [name for name in NAMES if theme.text not in opaque_colours(name)] == []


@pytest.mark.parametrize(("mode", "theme"), [("light", LIGHT), ("dark", DARK)], ids=["light", "dark"])
@pytest.mark.parametrize("ticked", [False, True])
def test_a_box_to_tick_has_its_frame_ticked_or_not(qtbot, appearance, mode, theme, ticked):
    appearance.choose(mode)
    box = QCheckBox("one pane each")
    qtbot.addWidget(box)
    box.setChecked(ticked)
    image = box.grab().toImage()
    # Of its left edge; the text, in another colour, is further right.
    edge = [image.pixelColor(x, image.height() // 2).name() for x in range(4)]
    assert theme.faint in edge
    colours = {image.pixelColor(x, y).name() for x in range(14) for y in range(image.height())}
    assert (TICK in colours) == ticked
    assert min(contrast(TICK, getattr(theme, ground)) for ground in ("base", "window")) > 3


def opaque_colours(name):
    image = icon(name).pixmap(64, 64).toImage()
    pixels = [image.pixelColor(x, y) for x in range(64) for y in range(64)]
    return {pixel.name() for pixel in pixels if pixel.alpha() == 255}
