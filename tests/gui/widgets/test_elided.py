"""A line without room is shortened, and its tool tip says all of it."""

from gui.widgets.elided import ElidedLabel

SAID = "9.81 of 9.81 m/s², +0.00 %"


def test_what_is_shortened_stands_in_the_tool_tip_above_its_own(made):
    label = made(ElidedLabel(SAID, "Of the base"))
    label.show()
    label.resize(label.sizeHint())
    assert (label.text(), label.toolTip()) == (SAID, "Of the base")
    label.resize(60, label.height())
    assert label.text().endswith("…")
    assert label.said == SAID
    assert label.toolTip() == f"{SAID}\nOf the base"
    label.say("–")
    assert (label.text(), label.toolTip()) == ("–", "Of the base")


def test_a_tip_of_its_own_goes_with_what_is_said(made):
    label = made(ElidedLabel(SAID, "Of the base"))
    label.show()
    label.resize(label.sizeHint())
    label.say("3 events", "which ones")
    assert label.toolTip() == "which ones"
    label.say("none")
    assert label.toolTip() == "which ones"
    label.say("none", "")
    assert label.toolTip() == ""


def test_larger_type_asks_for_more_room(made):
    label = made(ElidedLabel(SAID))
    label.show()
    before = label.sizeHint().width()
    font = label.font()
    font.setPointSizeF(2 * font.pointSizeF())
    label.setFont(font)
    assert label.sizeHint().width() > 1.5 * before
