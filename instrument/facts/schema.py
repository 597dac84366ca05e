"""The JSON schemas of every command's result, as files: `python -m instrument.facts.schema docs/schema`."""

import json
import re
import sys
from pathlib import Path
from typing import Any

from instrument.facts.batch import BatchResult
from instrument.facts.bench import BenchResult
from instrument.facts.card import CardResult
from instrument.facts.check import CheckResult
from instrument.facts.comparison import CompareResult
from instrument.facts.damping import DampingResult
from instrument.facts.diagnosis import DiagnosisResult
from instrument.facts.docstrings import DescribedSchema
from instrument.facts.doctor import DoctorResult
from instrument.facts.identification import IdentificationResult
from instrument.facts.modal import ModalResult
from instrument.facts.modes import ModesResult
from instrument.facts.plan import PlanResult
from instrument.facts.prediction import PredictionResult
from instrument.facts.result import Result
from instrument.facts.run import ReplayResult, RunResult
from instrument.facts.sensors import SensorsResult
from instrument.facts.shifted import ShiftedResult
from instrument.facts.written import ExportResult, ImportResult, NewResult, RecoverResult, ReportResult

RESULTS: dict[str, type[Result]] = {
    "batch": BatchResult,
    "bench": BenchResult,
    "card": CardResult,
    "check": CheckResult,
    "compare": CompareResult,
    "damping": DampingResult,
    "diagnose": DiagnosisResult,
    "doctor": DoctorResult,
    "sensors": SensorsResult,
    "export": ExportResult,
    "identify": IdentificationResult,
    "identify-modes": ModalResult,
    "identify-shift": ShiftedResult,
    "import": ImportResult,
    "modes": ModesResult,
    "new": NewResult,
    "plan": PlanResult,
    "predict": PredictionResult,
    "recover": RecoverResult,
    "replay": ReplayResult,
    "report": ReportResult,
    "run": RunResult,
}
"""By command; `hammer`, `sweep`, `demo` say what `run` does; `identify-modes` is of tables of modes,
`identify-shift` of `identify --shift`."""
_DIALECT = "https://json-schema.org/draft/2020-12/schema"


def is_a_result(facts: Any) -> bool:
    """Whether most keys of a JSON are those of a command's results, of this version or an earlier one."""
    keys = set(facts) if isinstance(facts, dict) else set()
    return any(2 * len(keys & set(result.model_fields)) > len(keys) for result in RESULTS.values())


def schema_of(command: str) -> dict[str, Any]:
    """Of what a command writes with `--json`."""
    return {
        "$schema": _DIALECT,
        **RESULTS[command].model_json_schema(mode="serialization", schema_generator=DescribedSchema),
    }


def write_schemas(folder: Path) -> list[Path]:
    """A file a command."""
    folder.mkdir(parents=True, exist_ok=True)
    for command in RESULTS:
        text = json.dumps(schema_of(command), indent=1, ensure_ascii=False, allow_nan=False)
        # What is NaN or None in a model is null in its JSON.
        said = re.sub(r"\b(NaN|None)\b", "null", text)
        (folder / f"{command}.json").write_text(said + "\n", encoding="utf-8")
    return [folder / f"{command}.json" for command in RESULTS]


if __name__ == "__main__":
    for path in write_schemas(Path(sys.argv[1] if len(sys.argv) > 1 else "docs/schema")):
        print(path)
