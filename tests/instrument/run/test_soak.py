"""A short form of `python tests/by_hand/soak.py --million 50`."""

from by_hand.soak import soak


def test_a_million_samples_pass_without_loss_faster_than_real_time(tmp_path):
    found = soak(1_000_000, tmp_path)
    assert found.samples >= 1_000_000
    assert found.gaps == 0
    assert found.times_real_time > 10
    assert found.grown_mb < 30
