"""What one attempt on a Modbus connection sent and heard: tells silence from an answer that is damaged."""

_SHOWN = 8
"""Bytes of a damaged answer that a message has room for."""


class Heard:
    """Given to the client, which passes every packet through it."""

    def __init__(self) -> None:
        self.forget()

    def __call__(self, sending: bool, data: bytes) -> bytes:
        """Take note, and change nothing."""
        if sending:
            self._sent = data
        else:
            # What has come so far of one answer, each time from its beginning.
            self._came = data
        return data

    def forget(self) -> None:
        """Another attempt begins."""
        self._sent = self._came = b""

    @property
    def damaged(self) -> str:
        """What came though it is no answer, for people; empty where nothing did."""
        if not self._came:
            return ""
        if self._sent and self._came.startswith(self._sent):
            return "what was sent came back: does its adapter echo?"
        begun = self._came[:_SHOWN].hex(" ") + (" ..." if len(self._came) > _SHOWN else "")
        return f"{len(self._came)} bytes came that are none ({begun})"
