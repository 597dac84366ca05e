from pathlib import Path

import numpy as np
import pytest
from engine_cases import engine_rig
from hammer_views import BAND_HZ, by_command
from hammer_views import hits as hits
from PySide6.QtCore import Qt
from quick_engine import QUICK_ENGINE
from session_cases import SyntheticSession, configuration

from fitting.modal.frf import Frf
from gui.feeds.live import LiveFeed
from gui.pages.hammer.traces import accelerance
from instrument.engine import Engine, Order
from instrument.files.experiment_file import ExperimentDocument
from instrument.interchange.found import Found
from instrument.results.error_words import ratio_words
from instrument.session.configuration import read_whole_experiment
from instrument.session.storage import SessionFile
from instrument.stream.derived import DampingFound, HitRevised

pytestmark = [pytest.mark.usefixtures("warm"), pytest.mark.pages("run", "hammer")]

LEFT = Qt.MouseButton.LeftButton
PATIENCE_MS = 240_000


@pytest.fixture
def page(qtbot, opened):
    """Of the session, its hits drawn."""
    opened.show_page("hammer")
    page = opened.pages[-1]
    qtbot.waitUntil(lambda: page._averaged is not None, timeout=PATIENCE_MS)
    return page


@pytest.fixture
def looked_at(qtbot, kept):
    """The same in the window of the whole module, everything computed; for tests that select at most."""
    kept.show_page("hammer")
    page = kept.pages[-1]
    qtbot.waitUntil(lambda: page._averaged is not None, timeout=PATIENCE_MS)
    return computed_whole(qtbot, page)


def computed_whole(qtbot, page):
    qtbot.waitUntil(lambda: page._modes is not None and page._expected_hz.size > 0, timeout=PATIENCE_MS)
    return page


def computed(qtbot, page, numbers):
    """Waits until the damping is that of these hits."""

    def done():
        modes = page._modes
        return modes is not None and [h.number for h in modes.hits if h.accepted] == numbers

    qtbot.waitUntil(done, timeout=PATIENCE_MS)


def numbers(page, column):
    """Of the damping table, without their errors; None where there is none."""
    texts = page.modes.table.texts(column)
    return [float(text.split(" ")[0]) if text[0].isdigit() else None for text in texts]


def may_press(page):
    return [b.isEnabled() for b in (page.hits.accept, page.hits.reject, page.hits.undo)]


def test_without_a_session_it_says_what_to_do(window):
    window.show_page("hammer")
    page = window.pages[-1]
    assert page.nothing.isVisible()
    assert "start a run" in page.nothing.text()


def test_an_experiment_without_a_hammer_test_says_so(qtbot, window, tmp_path):
    whole = configuration().experiment.model_dump(mode="json")
    del whole["hammer"]
    index = SyntheticSession(configuration(experiment=ExperimentDocument.model_validate(whole)))
    index.begin()
    index.sweep((1,), steps=2)
    index.end()
    window.show_page("hammer")
    window.open(index.save(tmp_path))
    qtbot.waitUntil(lambda: "no hammer test" in window.pages[-1].nothing.text(), timeout=PATIENCE_MS)
    assert window.pages[-1].nothing.isVisible()


def test_the_table_shows_what_was_recorded(looked_at, kept):
    page, opened = looked_at, kept
    recorded = opened.controller.state.contents.damping.result.modes
    assert page.modes.source.text() == "As recorded: hits 1, 3 of 3."
    assert numbers(page, 0) == [round(m.frequency_hz, 3) for m in recorded]
    for column, method in ((2, "rational_fit"), (3, "half_power"), (4, "lscf")):
        for shown, mode in zip(numbers(page, column), recorded, strict=True):
            estimate = mode.by(method)
            assert shown == (estimate and pytest.approx(100 * estimate.ratio, abs=1e-3))
    assert None in numbers(page, 3)
    said = [ratio_words(m.damping_ratio, m.rational_fit.standard_error, "±") for m in recorded]
    # A column has no room for a word.
    narrow = [words.replace("below ", "<") for words in said]
    assert [page.modes.table.cell(row, 2).text for row in range(len(said))] == narrow
    assert "refused: " in page.modes.table.cell(0, 3).tip
    assert numbers(page, 1) == pytest.approx(numbers(page, 0), rel=2e-3)
    assert not page.modes.back.isVisible()


def test_every_hit_has_its_verdict_and_what_can_be_said_of_it(looked_at):
    page = looked_at
    table = page.hits.table
    assert table.texts(3) == ["used", "left out", "used"]
    assert "double hit" in table.texts(4)[1]
    assert page.hits.number == 3
    page.hits.select(1)
    assert may_press(page) == [
        False,
        True,
        False,
    ]
    page.hits.select(2)
    assert may_press(page) == [
        True,
        False,
        False,
    ]
    assert not page.hits.use.isVisible()


def test_a_hit_rejected_is_a_what_if_and_the_file_stays(qtbot, looked_at, kept, session_path, hits):
    page, opened = looked_at, kept
    before = session_path.read_bytes()
    page.hits.select(1)
    qtbot.mouseClick(page.hits.reject, LEFT)
    computed(qtbot, page, [3])
    assert page.modes.source.text() == "What if, not recorded: hits 3 of 3."
    assert "what if" in page.hits.table.texts(3)[0]
    assert page._modes.result.as_json() == by_command(hits, [3]).as_json()
    assert session_path.read_bytes() == before
    assert [h.accepted for h in opened.controller.state.contents.hits] == [True, False, True]
    qtbot.mouseClick(page.modes.back, LEFT)
    computed(qtbot, page, [1, 3])
    assert page.modes.source.text() == "As recorded: hits 1, 3 of 3."


def test_keys_accept_and_undo(qtbot, looked_at, kept):
    page, opened = looked_at, kept
    page.hits.select(2)
    qtbot.keyClick(opened, Qt.Key.Key_A)
    computed(qtbot, page, [1, 2, 3])
    qtbot.keyClick(opened, Qt.Key.Key_U)
    computed(qtbot, page, [1, 3])
    qtbot.waitUntil(lambda: not page.hits.undo.isEnabled(), timeout=PATIENCE_MS)


def test_no_hit_used_is_said_in_words(qtbot, page):
    for number in (1, 3):
        page.hits.select(number)
        page.hits.reject.click()
    computed(qtbot, page, [])
    assert "no good hit" in page.modes.source.text()
    assert page.modes.table.row_count == 0
    assert not page.frf.coherence.names


def test_a_mode_selected_in_table_or_plot_is_shown_with_what_was_read_off_it(qtbot, looked_at):
    page = looked_at
    page.modes.select(2)
    f = page.modes.frequency_hz
    low, high = page.frf.magnitude.getViewBox().viewRange()[0]
    assert low < f < high < 1.2 * f
    names = page.frf.magnitude.names
    assert {"rational fit", "windowed", "half power, −3 dB"} <= set(names)
    columns = page.frf.magnitude.columns()
    width = np.ptp(columns["half power, −3 dB: Frequency (Hz)"])
    assert 0 < width < high - low
    qtbot.mouseClick(page.modes.whole, LEFT)
    assert page.frf.magnitude.getViewBox().viewRange()[0] == pytest.approx(BAND_HZ)
    assert "rational fit" not in page.frf.magnitude.names
    page.frf.magnitude.picked.emit("modes", 1)
    assert page.modes.table.selected == 1


def test_the_selected_hit_is_drawn(looked_at):
    page = looked_at
    page.hits.select(2)
    force = page.hit_plots.force.columns()["force: Force (N)"]
    seen = page._averaged.seen[2].judged
    assert force == pytest.approx(seen.hit.force_n)
    assert "selected hit" in page.hit_plots.spectrum.names


def test_an_frf_of_another_file_is_drawn_as_accelerance(page, opened):
    f = np.linspace(1.0, 500.0, 500)
    mobility = Frf(f, np.full(500, 2.0 + 0j), "velocity")
    opened.controller.beside[Path("other.uff")] = Found(frfs=[("3z over 1z", mobility, None)])
    opened.controller.beside_changed.emit()
    name = "other.uff: 3z over 1z"
    assert name in page.frf.magnitude.names
    assert name in page.frf.phase.names
    np.testing.assert_allclose(np.abs(accelerance(mobility).H), 4 * np.pi * f)
    np.testing.assert_allclose(np.angle(accelerance(mobility).H, deg=True), 90.0)


def test_records_of_another_file_are_drawn_as_the_average_of_its_good_hits_until_taken_away(
    qtbot, page, opened, hits
):
    opened.controller.beside[Path("other.csv")] = Found(hits=[h.record for h in hits])
    opened.controller.beside_changed.emit()
    name = "other.csv: 2 of 3 hits"
    qtbot.waitUntil(lambda: name in page.frf.magnitude.names and name in page.frf.phase.names)
    # The session's own hits, so its own average.
    for plot in (page.frf.magnitude, page.frf.phase):
        np.testing.assert_array_equal(plot.curves[name], plot.curves["average"])
    opened.controller.data_beside.take_away()
    assert name not in page.frf.magnitude.names
    assert name not in page.frf.phase.names


def test_before_the_first_blow_nothing_is_drawn(qtbot, page, opened):
    opened.controller.recorded.jump(0.0)
    qtbot.waitUntil(lambda: page.hits.table.row_count == 0, timeout=PATIENCE_MS)
    assert page.hit_plots.force.names == ()
    assert page.frf.magnitude.names == ()
    assert page.hits.prompt.text() == "No blow was caught so far."


def test_a_change_of_mind_is_forgotten_with_the_session(qtbot, page, opened, session_path):
    page.hits.select(1)
    page.hits.reject.click()
    opened.open(session_path)
    with qtbot.waitSignal(opened.controller.changed, timeout=PATIENCE_MS):
        pass
    computed(qtbot, page, [1, 3])
    assert "As recorded" in page.modes.source.text()


@pytest.fixture
def live(window, tmp_path):
    """A hammer test of two hits on a simulated rig; it waits for the word that they may be used."""
    with engine_rig(tmp_path, hammer=True) as (_, experiment):
        order = Order(experiment, tmp_path / "out", ("hammer",), ask_content=True)
        setup = read_whole_experiment(experiment).configuration("run", "")
        window.show_page("hammer")
        window.controller._show(LiveFeed(order, setup, window.controller, Engine.start(order, QUICK_ENGINE)))
        yield window.controller.live


def test_a_word_about_a_hit_goes_to_the_run(qtbot, window, live):
    page = window.pages[-1]
    qtbot.waitUntil(page.hits.use.isVisible, timeout=PATIENCE_MS)
    assert "use them" in page.hits.prompt.text()
    page.hits.select(1)
    qtbot.mouseClick(page.hits.reject, LEFT)
    qtbot.waitUntil(lambda: page.hits.table.row_count == 3, timeout=PATIENCE_MS)
    qtbot.waitUntil(page.hits.use.isVisible, timeout=PATIENCE_MS)
    assert page.hits.table.texts(3) == ["left out", "used", "used"]
    assert page.hits.table.texts(4)[0] == "rejected by the operator"
    computed(qtbot, page, [2, 3])
    assert page.modes.source.text().startswith("Preliminary: hits 2, 3 of 3.")
    preliminary = page._modes.result.as_json()["modes"]
    qtbot.mouseClick(page.hits.use, LEFT)
    qtbot.waitUntil(lambda: not window.controller.running, timeout=PATIENCE_MS)
    qtbot.waitUntil(lambda: page.modes.source.text() == "As recorded: hits 2, 3 of 3.", timeout=PATIENCE_MS)
    with SessionFile(live.ending.session) as file:
        events = list(file.events(with_samples=False))
    assert HitRevised(1, accepted=False) in events
    (found,) = [e for e in events if isinstance(e, DampingFound)]
    assert found.result.as_json()["modes"] == preliminary
