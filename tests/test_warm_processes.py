"""What is forked from a warm process is what would have been started."""

import os
import signal
import subprocess
import sys
import time

import pytest
from warm_processes import standing_in

pytestmark = [
    pytest.mark.usefixtures("warm"),
    pytest.mark.skipif(sys.platform != "linux", reason="processes are forked on Linux alone"),
]
LOADED = "import sys; print('instrument.engine.process' in sys.modules)"


def python(*words, **options):
    return subprocess.run([sys.executable, *words], capture_output=True, text=True, check=False, **options)


def test_it_has_the_rooms_unless_it_is_to_be_cold(request):
    assert python("-c", LOADED).stdout == "True\n"
    assert python("-c", LOADED, env={**os.environ, "PYTHONPATH": "elsewhere"}).stdout == "False\n"
    request.getfixturevalue("cold")
    assert python("-c", LOADED).stdout == "False\n"


def test_folder_environment_and_pipes_are_its_own(tmp_path):
    code = "import os, sys; print(os.getcwd(), os.environ['OWN'], sys.argv[1:], sys.stdin.read())"
    done = python("-c", code, "a", "b", cwd=tmp_path, env={**os.environ, "OWN": "1"}, input="said")
    assert (done.returncode, done.stdout, done.stderr) == (0, f"{tmp_path} 1 ['a', 'b'] said\n", "")


@pytest.mark.parametrize(
    ("code", "status", "said"),
    [
        ("raise SystemExit(3)", 3, ""),
        ("import atexit; atexit.register(print, 'bye')", 0, "bye\n"),
        ("1 / 0", 1, ""),
        ("import os, signal; os.kill(os.getpid(), signal.SIGINT); import time; time.sleep(9)", -2, ""),
    ],
)
def test_it_ends_as_python_ends(code, status, said):
    done = python("-c", code)
    assert (done.returncode, done.stdout) == (status, said)
    assert ("Traceback" in done.stderr) == (status in (1, -2))


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_its_pid_is_its_own(number):
    command = [sys.executable, "-c", "import os, time; print(os.getpid(), flush=True); time.sleep(60)"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True) as process:
        assert int(process.stdout.readline()) == process.pid
        assert os.getsid(process.pid) == process.pid
        assert process.poll() is None
        os.kill(process.pid, number)
        assert process.wait(10) == -number
    with pytest.raises(ProcessLookupError):
        os.kill(process.pid, 0)


def test_what_it_starts_is_warm_too():
    code = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {LOADED!r}])"
    assert python("-c", code).stdout == "True\n"


def stood_in(code):
    command = standing_in([sys.executable, "-c", code])
    return subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


def test_what_stands_in_for_it_has_its_streams_and_its_end():
    with stood_in(f"{LOADED}; print(input()); sys.exit(3)") as process:
        assert process.communicate("said\n")[0] == "True\nsaid\n"
        assert process.returncode == 3


def test_who_kills_what_stands_in_for_it_kills_it():
    with stood_in("import os, time; print(os.getpid(), flush=True); time.sleep(60)") as process:
        pid = int(process.stdout.readline())
        process.kill()
        # The end of its output: nobody has it open any more.
        assert process.stdout.read() == ""
    deadline = time.monotonic() + 10
    while os.path.exists(f"/proc/{pid}") and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not os.path.exists(f"/proc/{pid}")
