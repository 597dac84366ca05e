"""Beside a diagnosis that explains nothing: what a rig does to every mass alike."""

from dataclasses import replace

import numpy as np
import pytest
from shear_pair_cases import HEAVIER_KG, LAW, fixture_factor, pair, sweeps_of_masses

from instrument.finding.diagnosis import diagnose
from instrument.finding.files_at_work import FilesAtWork
from instrument.finding.transfer import with_transfer
from instrument.models.files import File
from instrument.progress import quiet


def files(*, alike):
    return [File(s, pair(m)) for s, m in zip(sweeps_of_masses(45, alike=alike), HEAVIER_KG, strict=True)]


def law_off(band):
    at = (band.frequency_hz > 80) & (band.frequency_hz < 500)
    G = LAW.modulus(2 * np.pi * band.frequency_hz[at])
    found = band.storage_modulus_pa[at] * (1 + 1j * band.loss_factor[at])
    return np.abs(found / G - 1).max()


@pytest.mark.parametrize("alike", [True, False])
def test_only_what_all_files_have_in_common_is_listed_and_changes_the_law(alike):
    given = files(alike=alike)
    # Nothing searched: as where the catalogue has explained nothing.
    before = diagnose(given, accept=[]).result
    work = FilesAtWork(given, quiet, with_effects=True)
    work.used = np.split(before.used, np.cumsum([len(one.sweep) for one in given])[:-1])
    found = with_transfer(before, work)
    listed = {c.name: c for c in found.channels}
    if not alike:
        assert found is before
        return
    values = {k: p.value for k, p in listed["fixture_transfer"].parameters.items()}
    true = np.log(fixture_factor(np.concatenate([one.sweep.frequency_hz for one in given])))
    assert values["gain"] == pytest.approx(np.mean(np.expm1(true.real)), abs=0.015)
    assert values["phase"] == pytest.approx(np.mean(true.imag), abs=0.01)
    assert values["largest"] == pytest.approx(np.abs(np.expm1(true)).max(), abs=0.05)
    assert law_off(found.after.band) < 0.4 * law_off(before.after.band)
    assert found.after.rms_percent < 0.5 * before.after.rms_percent
    assert found.after.validation.held_out_rms_percent < before.after.validation.held_out_rms_percent
    assert len(found.after.predicted_m_s) == len(before.after.predicted_m_s)
    assert "All files are off alike" in found.explanation[-1]


def test_a_factor_that_leaves_more_than_the_law_alone_changes_nothing():
    given = files(alike=True)
    before = diagnose(given, accept=[]).result
    # As if the law alone had left less.
    better = replace(before, before=replace(before.before, chi2_per_dof=1e-3))
    work = FilesAtWork(given, quiet, with_effects=True)
    work.used = np.split(before.used, np.cumsum([len(one.sweep) for one in given])[:-1])
    assert with_transfer(better, work) is better
