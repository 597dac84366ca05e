"""The page of the hammer test.

page.py       what stands where, and what follows when something changes
bench.py      computes, off the main thread: findings.py, no Qt
choice.py     hits taken otherwise than recorded, no Qt
words.py      rows of both tables, no Qt
hit_list.py, hit_plots.py, mode_table.py, frf_plots.py   the widgets
"""

from gui.pages.hammer.page import HammerPage

__all__ = ["HammerPage"]
