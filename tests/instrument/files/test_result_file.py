import json

import pytest
from result_cases import identification

from instrument.errors import BadInput
from instrument.facts.identification import IdentificationResult
from instrument.files.result_file import result_text, write_result


def test_what_is_written_is_read_back_with_what_is_not_known_left_so(tmp_path):
    found = identification(standard_errors={"g_pa": None}, chi2_per_dof=None)
    write_result(tmp_path / "found.json", found)
    text = (tmp_path / "found.json").read_text()
    assert text == result_text(found) + "\n"
    assert json.loads(text)["standard_errors"] == {"g_pa": None}
    assert result_text(IdentificationResult.model_validate(json.loads(text))) == result_text(found)


def test_where_it_cannot_be_written_is_said(tmp_path):
    with pytest.raises(BadInput, match="none"):
        write_result(tmp_path / "none" / "found.json", identification())
