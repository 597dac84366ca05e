"""Files opened at once have one message."""

from gui.actions.one_message import OneMessage


class Opened:
    """So many files are still to come."""

    def __init__(self, to_come):
        self.to_come, self.told = to_come, []
        self.message = OneMessage(
            lambda: self.to_come > 0,
            lambda line: self.told.append(("said", line)),
            lambda line: self.told.append(("refused", line)),
        )

    def one_comes(self):
        self.to_come -= 1


def test_what_is_said_of_each_is_said_with_what_was_said_before():
    opened = Opened(2)
    opened.one_comes()
    opened.message.say("a: read")
    opened.one_comes()
    opened.message.say("b: read")
    assert opened.told == [("said", "a: read"), ("said", "a: read; b: read")]
    opened.message.say("c: read")
    assert opened.told[-1] == ("said", "c: read")


def test_where_one_could_not_be_done_all_of_it_is_refused():
    opened = Opened(1)
    opened.message.refuse("a: empty")
    opened.one_comes()
    opened.message.say("b: read")
    assert opened.told[-1] == ("refused", "a: empty; b: read")


def test_of_what_comes_without_a_word_nothing_is_left_for_the_next():
    opened = Opened(1)
    opened.message.refuse("a: empty")
    opened.one_comes()
    opened.message.settle()
    opened.message.say("b: read")
    assert opened.told[-1] == ("said", "b: read")


def test_what_is_opened_anew_has_nothing_of_what_is_still_awaited():
    opened = Opened(1)
    opened.message.say("a: read")
    opened.message.begin()
    opened.message.say("b: read")
    assert opened.told[-1] == ("said", "b: read")
