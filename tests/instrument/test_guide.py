"""The guide says what is so: its commands run to the letter, its messages are those of the program."""

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

from instrument.files.sweep_file import read_sweep

ROOT = Path(__file__).parents[2]
GUIDE = ROOT / "docs" / "guide"
ROOMS = ("drivers", "fitting", "instrument", "gui")


def commands(page: Path) -> list[str]:
    """Of every block that is to be run, in order."""
    blocks = re.findall(r"```sh\n(.*?)```", page.read_text(encoding="utf-8"), re.DOTALL)
    return [line for block in blocks for line in block.splitlines() if line.strip()]


@pytest.mark.long
def test_the_first_result_is_reached_by_the_guides_commands_to_the_letter(tmp_path):
    found = commands(GUIDE / "first-result.md")
    assert len(found) >= 10
    path = os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])
    for line in found:
        ended = subprocess.run(
            line, shell=True, cwd=tmp_path, env=os.environ | {"PATH": path}, capture_output=True, text=True
        )
        assert ended.returncode == 0, f"{line}\n{ended.stdout[-2000:]}{ended.stderr[-2000:]}"
    for name in ("report.html", "core.bdf", "data"):
        assert (tmp_path / name).exists()


def test_the_guide_s_line_gives_every_row_of_a_sweep_its_temperature(tmp_path):
    page = (GUIDE / "first-result.md").read_text(encoding="utf-8")
    (line,) = re.findall(r"^ +(awk .*)$", page, re.MULTILINE)
    rows = ["# from the laboratory", "frequency_hz,velocity_m_s", "10,0.1", "11,0.2"]
    (tmp_path / "05.csv").write_text("\n".join([*rows, ""]))
    subprocess.run(line, shell=True, cwd=tmp_path, check=True)
    found = read_sweep(tmp_path / "at-05.csv")
    assert found.temperature_range_c == (5.2, 5.2)
    assert found.columns["frequency_hz"].tolist() == [10.0, 11.0]


def test_the_messages_explained_are_the_programs_own():
    sources = " ".join(
        path.read_text(encoding="utf-8") for room in ROOMS for path in (ROOT / room).rglob("*.py")
    )
    # What one statement says may stand on two lines.
    said = re.sub(r'"\s+f?"', "", sources)
    messages = (GUIDE / "trouble.md").read_text(encoding="utf-8").partition("\n## ")[0]
    rows = re.findall(r"^\| (`.*?) \|", messages, re.MULTILINE)
    explained = [quoted for row in rows for quoted in re.findall(r"`(.+?)`", row)]
    assert len(explained) >= 12
    unknown = [part for one in explained for part in one.split(" ... ") if part not in said]
    assert unknown == []
