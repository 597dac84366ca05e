"""What `viscorig identify` is asked for beside its data, and what of that does not go together."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import click

from fitting.depth.posterior import SAMPLES
from fitting.temperature.shifts import Kind
from instrument.cli.options import refuse_with_tables
from instrument.finding.methods import Method
from instrument.models.files import File
from instrument.results.uncertainty_facts import Depth


@dataclass(frozen=True)
class Asked:
    """The options as given; each check raises `click.UsageError`."""

    method: Method
    no_viscous_damping: bool
    pointwise: bool
    dma: Path | None
    with_budget: bool
    depths: tuple[Depth, ...]
    samples: int
    shift: Kind | None
    reference_c: float | None
    temperature_k: float | None
    vertical: bool
    bare: Path | None
    figures: Path | None

    def check(self) -> None:
        """What goes together whatever the data are."""
        if self.pointwise and self.method == "paper":
            raise click.UsageError("--pointwise and --method paper: expected the direct method")
        if self.samples != SAMPLES and "posterior" not in self.depths:
            raise click.UsageError("--samples: expected --uncertainty posterior with it")
        if self.figures is not None and not self.pointwise and self.dma is None and self.shift is None:
            raise click.UsageError(
                "--figures shows the law band by band, expected --pointwise, --with or --shift"
            )
        if self.shift is None and (
            self.reference_c is not None or self.temperature_k is not None or self.vertical
        ):
            raise click.UsageError(
                "--reference-c, --temperature-k and --vertical: expected --shift with them"
            )

    def check_tables(self, *, hammer: bool) -> None:
        """Of tables of modes; `hammer` says whether a test was given with them."""
        refuse_with_tables(
            {
                "--pointwise": self.pointwise,
                "--method paper": self.method == "paper",
                "--with": self.dma is not None,
                "--hammer": hammer,
                "--budget": self.with_budget,
            }
        )
        if set(self.depths) - {"profile"}:
            raise click.UsageError(
                "--uncertainty posterior and bootstrap with tables of modes: expected profile"
            )
        if self.shift is not None and (self.bare is not None or self.no_viscous_damping):
            raise click.UsageError(
                "--bare and --no-viscous-damping with --shift: expected tables of treated specimens alone"
            )

    def check_shift(self) -> None:
        """Of sweeps at several temperatures."""
        if set(self.depths) - {"profile"}:
            raise click.UsageError("--uncertainty posterior and bootstrap with --shift: expected profile")
        if self._of_one_sweep or self.no_viscous_damping or self.with_budget:
            raise click.UsageError(
                "--shift goes with --reference-c, --temperature-k, --vertical, --uncertainty profile, "
                "--hammer and --figures alone"
            )

    def check_together(self, files: Sequence[File]) -> None:
        """Of several files or spots, or of one that is no plate."""
        if self._of_one_sweep or self.no_viscous_damping:
            raise click.UsageError(
                "--pointwise, --method, --no-viscous-damping, --with: expected one plate read at one spot"
            )
        if set(self.depths) - {"profile"}:
            of = "several files or spots" if len(files) > 1 else f"a {files[0].specimen.kind}"
            raise click.UsageError(f"--uncertainty posterior and bootstrap with {of}: expected profile")

    @property
    def _of_one_sweep(self) -> bool:
        return self.pointwise or self.method == "paper" or self.dma is not None
