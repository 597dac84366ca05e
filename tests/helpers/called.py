"""Commands called in this process, as a user calls them."""

import json

from instrument.cli.main import run


def call(capsys, *arguments):
    """Exit status, standard output, standard error."""
    status = run([str(a) for a in arguments])
    captured = capsys.readouterr()
    return status, captured.out, captured.err


def facts(capsys, *arguments):
    """What a command that succeeds writes with `--json -`."""
    status, out, err = call(capsys, *arguments, "--json", "-")
    assert status == 0, err
    return json.loads(out)
