"""The engine's process: one order, one run, one end."""

import logging
import shlex
import signal
import threading
from functools import partial
from typing import BinaryIO

from drivers.errors import DriverError
from fitting.errors import FittingError
from instrument.engine.host import Host, LogToClient
from instrument.engine.mailbox import Mailbox
from instrument.engine.messages import Ended, Logged, Order, Why, ended
from instrument.engine.wire import encode, read
from instrument.errors import NOT_SILENT, BadInput, RigStopped, ShakerNotSilent, StoppedByUser, system_words
from instrument.run.experiment import run_experiment
from instrument.run.live_diagnosis import Diagnoser, diagnose_points
from instrument.run.live_fit import Fitter, fit_points
from instrument.session.configuration import read_whole_experiment

_OURS = ("instrument", "drivers", "fitting")


def serve(
    commands: BinaryIO, replies: BinaryIO, *, fit: Fitter | None = None, diagnose: Diagnoser | None = None
) -> None:
    """Read an order, run it, tell everything. On the main thread; returns when the client has it all.

    Another `fit` or `diagnose` is for tests.
    """
    # Nothing may break in before the run is there to end safely.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    order = read(commands)
    if not isinstance(order, Order):
        return
    host = Host(ask_content=order.ask_content)
    _tell_log(host.mailbox)
    sender = threading.Thread(target=_send, args=(host.mailbox, replies), name="to the client")
    sender.start()
    threading.Thread(target=host.listen, args=(commands,), name="from the client", daemon=True).start()
    host.mailbox.put(
        _run(
            order,
            host,
            fit or partial(fit_points, progress=host.progress),
            diagnose or partial(diagnose_points, progress=host.progress),
        )
    )
    host.mailbox.close()
    sender.join()


def _run(order: Order, host: Host, fit: Fitter, diagnose: Diagnoser) -> Ended:
    """The run, and how it ended; never raises."""
    try:
        with host.interruption:
            finished = run_experiment(
                read_whole_experiment(order.experiment),
                order.out,
                order.parts,
                control=host.control,
                resume=order.resume,
                progress=host.progress,
                fit=fit,
                diagnose=diagnose,
                companion=host,
            )
        return Ended("done", "", finished.session)
    except StoppedByUser as error:
        return _ended("stopped by the user", error, host)
    except KeyboardInterrupt:
        return _ended("stopped by the user", _left(host), host)
    except (BadInput, FittingError) as error:
        return _ended("bad input", error, host)
    except ShakerNotSilent as error:
        return _ended(NOT_SILENT, error, host)
    except (RigStopped, DriverError) as error:
        return _ended("stopped safely", error, host)
    except OSError as error:
        return _ended("bad input", f"{error.filename or 'output'}: {system_words(error)}", host)
    except Exception as error:  # a fault of this program: the client must hear of an end all the same
        logging.getLogger(__name__).debug("internal error", exc_info=True)
        return _ended("stopped safely", f"internal error, {type(error).__name__}: {error}", host)


def _ended(why: Why, said: object, host: Host) -> Ended:
    return ended(why, " ".join(str(said).split()), host.recorded)


def _left(host: Host) -> str:
    """Of a run that was broken off before it could say."""
    if host.recorded is None or not host.recorded.folder.is_dir():
        return "nothing was measured"
    folder = host.recorded.folder
    return f"what is complete is in {folder}: viscorig recover {shlex.quote(str(folder))}"


def _send(mailbox: Mailbox, replies: BinaryIO) -> None:
    """Until the mailbox is closed and empty, or nobody reads any more."""
    try:
        while (message := mailbox.take()) is not None:
            try:
                frame = encode(message)
            except ValueError as error:
                frame = encode(Logged("", "ERROR", f"{type(message).__name__} cannot be told: {error}"))
            replies.write(frame)
            replies.flush()
    except OSError:
        # The client has gone; the thread that listens to it ends the run.
        mailbox.close()


def _tell_log(mailbox: Mailbox) -> None:
    logging.captureWarnings(True)
    for name in (*_OURS, "py.warnings"):
        logger = logging.getLogger(name)
        logger.setLevel(logging.INFO)
        logger.propagate = False
        logger.addHandler(LogToClient(mailbox))
