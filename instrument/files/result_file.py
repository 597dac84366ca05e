"""A result as the JSON file that commands write."""

import json
from pathlib import Path

from instrument.facts.result import Result
from instrument.files.at_once import write_at_once


def result_text(found: Result) -> str:
    """The facts as JSON, without a line's end."""
    return json.dumps(found.as_json(), indent=1, allow_nan=False)


def write_result(path: Path, found: Result) -> None:
    """Whole or not at all. Raises `BadInput` where it cannot be written."""
    write_at_once(path, result_text(found) + "\n")
