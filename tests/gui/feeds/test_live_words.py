"""What a run asks a person for, in the words of its specimen."""

from types import SimpleNamespace

import pytest

from gui.feeds.live import LiveFeed
from instrument.engine.messages import OperatorAsked, Order
from instrument.files.new_file import write_new
from instrument.session.configuration import Configuration, read_whole_experiment
from instrument.simulated_case import write_case


def configured(folder, kind) -> Configuration:
    """An experiment of a specimen of that kind."""
    path = write_case(folder)
    if kind != "plate":
        specimen = folder / "specimen.toml"
        specimen.unlink()
        write_new(kind, specimen)
    return read_whole_experiment(path).configuration("run", "")


@pytest.mark.parametrize(
    ("kind", "said"), [("plate", "plate"), ("beam", "beam"), ("shear-pair", "shear pair")]
)
def test_what_is_to_be_mounted_is_called_what_it_is(qapp, tmp_path, kind, said):
    feed = LiveFeed(
        Order(tmp_path / "experiment.toml", tmp_path), configured(tmp_path, kind), None, SimpleNamespace()
    )
    feed._take(OperatorAsked("mount", "damped"))
    assert feed.state.run.question == f"mount the damped {said}, nothing else on it"
