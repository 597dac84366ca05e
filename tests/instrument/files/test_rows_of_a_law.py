"""The table of a core's law, read into the specimen's own document."""

import json

import numpy as np
import pytest
from pydantic import BaseModel

from instrument.errors import BadInput
from instrument.files.law_table import COLUMNS, with_rows

ROWS = [(100.0, 5e5, 0.9), (10.0, 3e5, 0.6), (1000.0, 8e5, 0.7)]
HEAD = ",".join(COLUMNS)
SORTED = [list(column) for column in zip(*sorted(ROWS), strict=True)]


class Core(BaseModel):
    poisson: float = 0.49
    law: dict[str, object]


class Document(BaseModel):
    core: Core | None = None


def of(path, **more):
    return Document(core=Core(law={"kind": "table", "path": path, **more}))


def columns(document):
    return [document.core.law[name] for name in COLUMNS]


def csv(folder, text=None):
    rows = "".join(f"{f!r},{G!r},{eta!r}\n" for f, G, eta in ROWS)
    (folder / "law.csv").write_text(f"{HEAD}\n{rows}" if text is None else text)
    return "law.csv"


def card(folder, content):
    (folder / "law.json").write_text(content if isinstance(content, str) else json.dumps(content))
    return "law.json"


def test_rows_of_a_csv_stand_in_the_document_ascending_in_frequency(tmp_path):
    found = with_rows(of(csv(tmp_path)), tmp_path / "plate.toml")
    assert columns(found) == SORTED
    # What was said beside them stays, and the document that was given is as it was.
    assert found.core.law["path"] == "law.csv"
    assert found.core.poisson == 0.49


def test_a_material_card_s_rows_are_the_same_and_what_else_it_says_is_left(tmp_path):
    law = [
        {**dict(zip(COLUMNS, row, strict=True)), "storage_modulus_standard_error_pa": None} for row in ROWS
    ]
    assert (
        columns(with_rows(of(card(tmp_path, {"law": law, "words": "x"})), tmp_path / "plate.toml")) == SORTED
    )


def test_tension_becomes_shear_by_the_core_s_own_poisson_s_ratio(tmp_path):
    text = "# kind: tension\n" + ",".join(COLUMNS) + "\n10,3e6,0.6\n"
    document = of(csv(tmp_path, text))
    found = with_rows(
        document.model_copy(update={"core": Core(poisson=0.25, law=document.core.law)}),
        tmp_path / "plate.toml",
    )
    assert found.core.law["storage_modulus_pa"] == pytest.approx([3e6 / 2.5])


@pytest.mark.parametrize(
    "document",
    [
        Document(),
        Document(core=Core(law={"kind": "constant", "g_mpa": 1.0})),
        of("nowhere.csv", **dict(zip(COLUMNS, SORTED, strict=True))),
    ],
    ids=["no core", "another law", "rows already"],
)
def test_what_asks_for_no_table_is_left_as_it_is(tmp_path, document):
    assert with_rows(document, tmp_path / "plate.toml") is document


FAULTS = {
    "no path": ({"path": ""}, None, r"plate\.toml: core\.law\.path: '', expected a CSV with frequency_hz"),
    "no file": (
        {"path": "none.csv"},
        None,
        r"plate\.toml: core\.law\.path: 'none\.csv': no such file, expected",
    ),
    "no key": ({"path": None}, None, r"plate\.toml: core\.law\.path: missing, expected"),
    "twice": ({"path": "law.csv"}, "10,3e5,0.6\n10,4e5,0.6\n", "frequency_hz = 10 twice, expected each once"),
}


@pytest.mark.parametrize("what", FAULTS)
def test_a_table_that_is_none_is_refused_in_one_line(tmp_path, what):
    law, rows, said = FAULTS[what]
    csv(tmp_path, None if rows is None else f"{','.join(COLUMNS)}\n{rows}")
    with pytest.raises(BadInput, match=said) as refused:
        with_rows(of(**law), tmp_path / "plate.toml")
    assert "\n" not in str(refused.value)


def test_tables_at_two_temperatures_are_not_the_core_as_it_is_measured(tmp_path):
    head = f"{','.join(COLUMNS)},temperature_c\n"
    csv(tmp_path, head + "10,3e5,0.6,20\n10,4e5,0.6,30\n")
    with pytest.raises(BadInput, match=r"temperature_c: 2 temperatures \(20 to 30\), expected one"):
        with_rows(of("law.csv"), tmp_path / "plate.toml")


CARDS = {
    "not JSON": ("{\n law", "line 2: not JSON .*, expected a material card's JSON"),
    "no card": ({"laws": []}, "expected a material card's JSON: law"),
    "a row without its loss": ({"law": [{"frequency_hz": 1, "storage_modulus_pa": 2}]}, "loss_factor"),
    "not a number": ({"law": [dict(zip(COLUMNS, (1, 2, "x"), strict=True))]}, "loss_factor"),
    "too deep": ("[" * 200_000, "too deep"),
}


@pytest.mark.parametrize("what", CARDS)
def test_a_card_that_is_none_is_refused_in_one_line(tmp_path, what):
    content, said = CARDS[what]
    with pytest.raises(BadInput, match=said) as refused:
        with_rows(of(card(tmp_path, content)), tmp_path / "plate.toml")
    assert "\n" not in str(refused.value)


def test_columns_are_arrays_of_numbers_that_a_session_can_keep(tmp_path):
    found = with_rows(of(csv(tmp_path)), tmp_path / "plate.toml")
    assert json.loads(found.model_dump_json())["core"]["law"]["frequency_hz"] == SORTED[0]
    assert all(type(x) is float for column in columns(found) for x in column)
    assert np.all(np.diff(found.core.law["frequency_hz"]) > 0)
