"""`viscorig bench`: the performance table."""

from dataclasses import asdict

import click

from instrument.bench.table import run_bench
from instrument.cli.options import json_option
from instrument.cli.output import Output
from instrument.facts.bench import BenchResult, BenchRow
from instrument.progress import bar


@click.command()
@json_option
def bench(json_path: str | None) -> None:
    """Time the reduced model against direct solves and the paper's procedure, in this run on this machine."""
    out = Output(json_path)
    rows = run_bench(bar)
    table = [
        [
            r.name,
            f"{r.seconds:.4g}",
            f"{r.ratio:,.3g}" if r.ratio is not None else "",
            r.to or "",
            f"{r.max_relative_error:.1e}" if r.max_relative_error is not None else "",
        ]
        for r in rows
    ]
    out.table("", ["what", "seconds", "times faster", "than", "max relative error"], table)
    out.result(BenchResult(rows=tuple(BenchRow(**asdict(row)) for row in rows)))
