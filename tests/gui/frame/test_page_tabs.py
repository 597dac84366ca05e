"""No page makes a window larger than its screen."""

from PySide6.QtWidgets import QLabel, QMainWindow

from gui.frame.page_tabs import PageTabs


def test_a_page_that_asks_for_more_than_the_screen_has_is_cut(made):
    window, tabs = made(QMainWindow()), PageTabs()
    window.setCentralWidget(tabs)
    screen = window.screen().availableSize()
    small, large = QLabel("small"), QLabel("large")
    small.setMinimumSize(200, 100)
    tabs.addTab(small, "small")
    assert (tabs.minimumSizeHint().width() >= 200, tabs.minimumSizeHint().height() >= 100) == (True, True)
    large.setMinimumSize(2 * screen.width(), 2 * screen.height())
    tabs.addTab(large, "large")
    window.resize(400, 300)
    window.show()
    assert window.width() <= screen.width()
    # Room for what is always seen is left below and above.
    assert window.height() <= screen.height() - 100
