"""Processes that have the rooms in memory already: `Popen`, for tests whose claim is no start.

A command or an engine takes a second of processor time to import what it needs. Here a process that has all
of it, and has done nothing with it, forks instead: what is started has a pid, pipes, environment, folder,
session and signals of its own, and ends as Python ends. What it starts in turn is warm too. What is no
program of this Python, wants another environment of Python or is to start in a special way starts as ever;
so does everything where there is no Linux. What starts programs without `Popen`, as Qt does, starts this file
with the program's words (`standing_in`): it has the streams and the end of the process forked, and is killed
with it.
"""

import gc
import inspect
import os
import pickle
import runpy
import select
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from types import ModuleType

# In one string: to import a module here is no test of it.
_ROOMS = "instrument.cli.batch instrument.cli.run instrument.cli.simulate instrument.engine.process"
FORK_AT = "VISCORIG_TESTS_FORK_AT"
"""In the environment of every process that may ask for another one."""
_READ_AT_START = ("PYTHON", "OPENBLAS_", "OMP_", "LC_", "LANG")
_SPECIAL = {"executable": None, "preexec_fn": None, "pass_fds": (), "shell": False, "umask": -1}
_PIPES = ("p2cread", "p2cwrite", "c2pread", "c2pwrite", "errread", "errwrite")
_COLD = subprocess.Popen
_SIGNATURE = inspect.signature(_COLD._execute_child)
_LONGEST = 1 << 17
_STANDING_IN = "--standing-in"


class Popen(subprocess.Popen):
    """As `subprocess.Popen`."""

    _over: threading.Event | None = None

    def _execute_child(self, *given):
        asked = _SIGNATURE.bind(self, *given).arguments
        words = [os.fspath(w) for w in ([asked["args"]] if isinstance(asked["args"], str) else asked["args"])]
        environment = dict(os.environ if asked["env"] is None else asked["env"])
        if any(asked[n] != v for n, v in _SPECIAL.items()) or not known(words, environment):
            super()._execute_child(*given)
            return
        pipes = {name: asked[name] for name in _PIPES}
        ends = pipes["p2cread"], pipes["c2pwrite"], pipes["errwrite"]
        order = words, environment, os.path.abspath(asked["cwd"] or ""), asked["start_new_session"], False
        connection = _asked(order, [number if end == -1 else end for number, end in enumerate(ends)])
        self._close_pipe_fds(*pipes.values())
        self._over = threading.Event()
        self.pid = int(connection.recv(_LONGEST))
        self._child_created = True
        threading.Thread(target=self._follow, args=(connection,), daemon=True).start()

    def _follow(self, connection: socket.socket) -> None:
        with connection:
            self.returncode = os.waitstatus_to_exitcode(int(connection.recv(_LONGEST)))
        self._over.set()

    def poll(self):
        return super().poll() if self._over is None else self.returncode

    def wait(self, timeout=None):
        if self._over is None:
            return super().wait(timeout)
        if not self._over.wait(timeout):
            raise subprocess.TimeoutExpired(self.args, timeout)
        return self.returncode


def _asked(order: tuple, streams: list[int]) -> socket.socket:
    """Where the pid is told, and then the end."""
    connection = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    connection.connect(os.environ[FORK_AT])
    socket.send_fds(connection, [pickle.dumps(order)], streams)
    return connection


def standing_in(words: list[str]) -> list[str]:
    """A command that is that of `words`, forked, and begins in hundredths of a second."""
    return [sys.executable, "-S", __file__, _STANDING_IN, *words]


def _stand_in(words: list[str]) -> None:
    """For another process, in its streams; who kills this one kills that."""
    with _asked((words, dict(os.environ), os.getcwd(), False, True), [0, 1, 2]) as connection:
        connection.recv(_LONGEST)
        code = os.waitstatus_to_exitcode(int(connection.recv(_LONGEST)))
    if code < 0:
        os.kill(os.getpid(), -code)
    os._exit(code)


def known(words: list[str], environment: dict[str, str]) -> bool:
    """Whether the process that forks is what this would be once it has begun."""
    if FORK_AT not in os.environ or words[0] != sys.executable or len(words) < 2:
        return False
    is_program = words[1] in ("-m", "-c") or not words[1].startswith("-")
    return is_program and _read_at_start(environment) == _read_at_start(os.environ)


def _read_at_start(environment) -> dict[str, str]:
    return {name: value for name, value in environment.items() if name.startswith(_READ_AT_START)}


@contextmanager
def forking() -> Iterator[None]:
    """While it lasts, `Popen` has something to fork from."""
    if sys.platform != "linux":
        yield
        return
    with _COLD(
        [sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
    ) as process:
        before = os.environ.get(FORK_AT)
        os.environ[FORK_AT] = process.stdout.readline().rstrip()
        try:
            yield
        finally:
            del os.environ[FORK_AT]
            if before is not None:
                os.environ[FORK_AT] = before


# In the process that forks, and those it forks.


def _ordered(folder: Path) -> tuple | None:
    """What the process has to be that this has become; None at the end of the one that forks."""
    listening = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
    listening.bind(str(folder / "at"))
    listening.listen(64)
    for room in _ROOMS.split():
        import_module(room)
    gc.collect()
    gc.freeze()
    on_interrupt = signal.signal(signal.SIGINT, signal.SIG_IGN)
    print(folder / "at", flush=True)
    while select.select([listening, sys.stdin], [], [])[0] == [listening]:
        connection, _ = listening.accept()
        if os.fork() == 0:
            listening.close()
            order = _begun(connection)
            signal.signal(signal.SIGINT, on_interrupt)
            return order
        connection.close()
        _bury()
    _bury()
    return None


def _bury() -> None:
    """Those that have ended: what they took of the processor counts as that of the test run."""
    with suppress(ChildProcessError):
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass


def _begun(connection: socket.socket) -> tuple:
    """The order, in the process that has to follow it; another one stays and tells its pid and its end."""
    message, streams, _, _ = socket.recv_fds(connection, _LONGEST, 3)
    *order, tied = pickle.loads(message)
    child = os.fork()
    if child != 0:
        for signal_of_all in (signal.SIGHUP, signal.SIGTERM):
            signal.signal(signal_of_all, signal.SIG_IGN)
        os.closerange(0, 3)
        for stream in streams:
            os.close(stream)
        with suppress(OSError):
            connection.send(str(child).encode())
        if tied:
            _end_with(connection, child)
        _, status = os.waitpid(child, 0)
        with suppress(OSError):
            connection.send(str(status).encode())
        os._exit(0)
    connection.close()
    for number, stream in enumerate(streams):
        os.dup2(stream, number)
        os.close(stream)
    return tuple(order)


def _end_with(connection: socket.socket, child: int) -> None:
    """Wait for the child's end, and bring it about where nobody waits for it any more."""
    ended = os.pidfd_open(child)
    if connection in select.select([connection, ended], [], [])[0]:
        os.kill(child, signal.SIGKILL)


def _become(words: list[str], environment: dict[str, str], folder: str, session: bool) -> None:
    if session:
        os.setsid()
    os.chdir(folder)
    os.environ.clear()
    os.environ.update(environment)
    subprocess.Popen = Popen
    kind, *rest = words[1:]
    if kind == "-m":
        sys.argv, sys.path[0] = rest, folder
        runpy.run_module(rest[0], run_name="__main__", alter_sys=True)
    elif kind == "-c":
        sys.argv, sys.path[0] = ["-c", *rest[1:]], ""
        sys.modules["__main__"] = main = ModuleType("__main__")
        exec(compile(rest[0], "<string>", "exec"), vars(main))
    else:
        sys.argv, sys.path[0] = [kind, *rest], str(Path(kind).parent)
        runpy.run_path(kind, run_name="__main__")


if __name__ == "__main__" and sys.argv[1:2] == [_STANDING_IN]:
    _stand_in(sys.argv[2:])
elif __name__ == "__main__":
    place = Path(tempfile.mkdtemp(prefix="fork-"))
    wanted = _ordered(place)
    if wanted is None:
        shutil.rmtree(place)
    else:
        _become(*wanted)
