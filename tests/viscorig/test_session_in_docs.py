"""The session that the page of the API shows runs as it stands."""

import re

import numpy as np
from data_folder import DATA


def test_the_session_of_the_page_runs(monkeypatch, capsys, tmp_path):
    page = (DATA.parent.parent / "docs" / "api.md").read_text(encoding="utf-8")
    (session,) = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(session, names)
    said = capsys.readouterr().out
    assert "3 modes" in said
    assert "loss factor" in said
    assert names["why"].verdict in said
    assert np.iscomplexobj(names["G"])
    assert names["v"].shape == names["G"].shape == (3,)
    assert {path.name for path in tmp_path.iterdir()} == {"law.json", "law.png"}
