"""The operator at the other end of the pipe: asked there, answers from there."""

import threading
from collections.abc import Callable
from typing import Literal

from instrument.engine.messages import Answered, Decided, Message, OperatorAsked
from instrument.facts.follow_up import FollowUp
from instrument.run.control import RunControl
from instrument.run.operator import Operator, follow_up_words
from instrument.stream.raw import OperatorDid


class RemoteOperator:
    """`Operator` by messages. `answer` is called on the thread that reads them.

    Parameters
    ----------
    put
        Sends a message.
    ask_content
        Whether enough hits wait for the word that they may be used; else they are used at once.
    """

    def __init__(self, put: Callable[[Message], None], ask_content: bool) -> None:
        self._put, self._ask_content = put, ask_content
        self._changed = threading.Condition()
        self._answers: set[str] = set()
        self._decisions: list[OperatorDid] = []
        self._content_asked = False

    def answer(self, message: Answered | Decided) -> None:
        """What came from the client; an answer that nothing was asked for is forgotten when something is."""
        with self._changed:
            if isinstance(message, Decided):
                self._decisions.append(OperatorDid(message.what, "", message.hit))
            else:
                self._answers.add(message.what)
            self._changed.notify_all()

    def mount(self, plate: str) -> OperatorDid:
        """Ask, and wait for the answer."""
        self._ask(OperatorAsked("mount", plate), "mounted")
        return OperatorDid("mounted", plate)

    def aim(self, point: str) -> OperatorDid:
        """Ask, and wait for the answer."""
        self._ask(OperatorAsked("aim", point), "aimed")
        return OperatorDid("aimed", point)

    def agree(self, offer: FollowUp) -> bool:
        """Ask, and wait for the answer."""
        said = f"{offer.todo} {offer.why} {follow_up_words(offer)}."
        question = _about("follow-up", said, offer)
        return self._ask(question, "agreed", "declined") == "agreed"

    def change(self, offer: FollowUp) -> OperatorDid:
        """Ask, and wait for the answer."""
        self._ask(_about("change", offer.todo, offer), "changed")
        return OperatorDid("changed", offer.todo)

    def hit(self, good: int, wanted: int) -> None:
        """Ask for a blow."""
        self.forget_content()
        self._put(OperatorAsked("hit", good=good, wanted=wanted))

    def decided(self) -> list[OperatorDid]:
        """What has come since the last time."""
        with self._changed:
            found, self._decisions = self._decisions, []
            return found

    def content(self, good: int) -> bool:
        """Ask once; whether the answer has come."""
        if not self._ask_content:
            return True
        with self._changed:
            if not self._content_asked and "content" not in self._answers:
                self._put(OperatorAsked("content", good=good))
            self._content_asked = True
            return "content" in self._answers

    def overrule(self, control: RunControl) -> None:
        """What is said to the sweep comes by messages of its own."""

    def forget_content(self) -> None:
        """Another hit is wanted: what was said of those before does not hold for it."""
        with self._changed:
            self._answers.discard("content")
            self._content_asked = False

    def wait(self) -> None:
        """Until there is a decision about a hit, or the hits may be used."""
        with self._changed:
            self._changed.wait_for(lambda: self._decisions or "content" in self._answers)

    def _ask(self, question: OperatorAsked, *answers: str) -> str:
        with self._changed:
            self._answers.difference_update(answers)
            self._put(question)
            self._changed.wait_for(lambda: self._answers.intersection(answers))
            return next(a for a in answers if a in self._answers)


class HelpedOperator:
    """`Operator` of a simulated rig: it acts by itself, the client decides about hits.

    Parameters
    ----------
    acting
        Mounts, aims and strikes.
    deciding
        Is asked about the hits.
    in_virtual_time
        Then time stands still while the client makes up its mind.
    """

    def __init__(self, acting: Operator, deciding: RemoteOperator, *, in_virtual_time: bool) -> None:
        self._acting, self._deciding, self._in_virtual_time = acting, deciding, in_virtual_time

    def mount(self, plate: str) -> OperatorDid:
        """Have the rig mount a plate."""
        return self._acting.mount(plate)

    def aim(self, point: str) -> OperatorDid:
        """Have the rig point the laser."""
        return self._acting.aim(point)

    def agree(self, offer: FollowUp) -> bool:
        """Ask the client whether an offer is taken."""
        return self._deciding.agree(offer)

    def change(self, offer: FollowUp) -> OperatorDid:
        """Have the rig change what an offer asks for."""
        return self._acting.change(offer)

    def hit(self, good: int, wanted: int) -> None:
        """Have the rig strike the plate."""
        self._deciding.forget_content()
        self._acting.hit(good, wanted)

    def decided(self) -> list[OperatorDid]:
        """What the client has decided since the last time."""
        return self._deciding.decided()

    def overrule(self, control: RunControl) -> None:
        """What is said to the sweep comes by messages of its own."""

    def content(self, good: int) -> bool:
        """Whether the client is. In virtual time this waits: samples nobody needs would come in masses."""
        content = self._deciding.content(good)
        if not content and self._in_virtual_time:
            self._deciding.wait()
        return self._deciding.content(good)


def _about(what: Literal["follow-up", "change"], said: str, offer: FollowUp) -> OperatorAsked:
    """With where it is to be done, and what goes there."""
    if offer.mass_kg is not None:
        return OperatorAsked(what, said, at_mm=offer.mass_at_mm, mark=f"{1e3 * offer.mass_kg:g} g")
    if offer.kind == "damped_struck":
        free = offer.held == "free"
        return OperatorAsked(what, said, at_mm=offer.struck_mm, mark="hit", read_mm=offer.spot_mm, free=free)
    if offer.kind == "clamping":
        return OperatorAsked(what, said, mark="clamp")
    return OperatorAsked(what, said, at_mm=offer.spot_mm, mark="laser")
