r"""What a person sends from a terminal to a command and all its processes: Ctrl-C, and Ctrl-\."""

import signal

BY_A_PERSON = tuple(getattr(signal, name) for name in ("SIGINT", "SIGQUIT") if hasattr(signal, name))
r"""A terminal sends these to every process of a command; the first one hears them and ends the others.

Unheard, either would end a run with its shaker on until its own watchdog.
"""
