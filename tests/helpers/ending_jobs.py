"""Jobs that end the process they are done in; apart from the tests, whose imports take it a second each."""

import os
import signal


def end_once(job):
    """Whoever is first ends its process."""
    folder, name = job
    try:
        os.close(os.open(os.path.join(folder, "ended"), os.O_CREAT | os.O_EXCL))
    except FileExistsError:
        return name
    return os.kill(os.getpid(), signal.SIGKILL)


def end_always(path):
    os.kill(os.getpid(), signal.SIGKILL)
