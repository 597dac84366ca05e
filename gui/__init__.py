"""The window. Qt lives here and nowhere else, and no measurement logic does.

    command.py, application.py  what starts it
    frame/      the window and what is arranged around the pages: menus, tabs, log, settings
    pages/      one view each, drawn from the state; page.py what every one of them is
    bars/       always seen: how a run stands and STOP; a recording's player
    actions/    what a person can do, and what came of it; controller.py for all pages and keys
    feeds/      where events come from: a run in its engine, a recorded session
    form/       a form for a file
    plots/      the plot every page uses
    background/ work beside the main thread: task.py, one_command.py, writing.py
    widgets/    small ones, and questions to a person
    style/      theme.py the colours; icons.py the signs
    state/      what is known so far, made of events; no Qt
    files/      what is known of files that a person chose; no Qt

A folder uses only those below it in this list, as pyproject.toml has it in full.

A page is added in two steps: a file in `pages/` with a `Page` in it (`title`, `refresh(state)`), and its name
in `pages.PAGES`; another package adds one by an entry point (docs/plugins.md). The window gives it the
key Ctrl+(its place) and calls `refresh` at most 30 times a second, only while the page is seen and something
has changed. In `refresh` ask `self.news("points")` before drawing: true where one of these topics changed
since the page last asked. Draw with `plot.line`, `points`, `band`: the same name again replaces a curve. What
a person does goes to `self.controller`. Long work goes to `BackgroundTask` (files) or
`BackgroundCommand` (computing); connect bound methods of widgets only.
"""
