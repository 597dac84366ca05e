"""The window. Qt lives here and nowhere else, and no measurement logic does.

    feeds/      where events come from: a run in its engine, a recorded session
    state/      what is known so far, made of those events; no Qt
    pages/      one view each, drawn from that state; page_set.py those of a window
    plots/      the plot every page uses; theme.py its colours
    controller.py   what a person can do: open, start, hold, stop, answer
    background_task.py  long work off the main thread; one_command.py one command at a time
    work_bar.py how far it is; writing.py files written in the background
    rediagnosis.py  a diagnosis made here, by hand or of other data; never recorded
    window.py   all of it on the screen

A page is added in two steps: a file in `pages/` with a `Page` in it (`title`, `refresh(state)`), and its name
in `pages.PAGES`; another package adds one by an entry point (docs/plugins.md). The window gives it the
key Ctrl+(its place) and calls `refresh` at most 30 times a second, only while the page is seen and something
has changed. In `refresh` ask `self.news("points")` before drawing: true where one of these topics changed
since the page last asked. Draw with `plot.line`, `points`, `band`: the same name again replaces a curve. What
a person does goes to `self.controller`. Long work goes to `BackgroundTask` (files) or
`BackgroundCommand` (computing); connect bound methods of widgets only.
"""
