"""A run in a process of its own, and its client.

The client (a window) starts an engine, is told everything that happens, and may hold, abort or stop:

    engine = Engine.start(Order(experiment=path, out=folder))
    while engine.running:
        for message in engine.poll():           # never blocks
            ...
    engine.stop()                               # on a thread that may wait: at most a second or so

A rig file whose addresses are "simulated" makes the engine stand the rig up itself, in virtual time:
`instrument.simulated_case.write_case` writes the files of one. Where the client ends, the engine ends the run
safely. The kinds of messages are in `messages.py`.
"""

from instrument.engine.client import Engine, Stopped
from instrument.engine.messages import Order

__all__ = ["Engine", "Order", "Stopped"]
