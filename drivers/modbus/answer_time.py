"""How long an answer on a serial line is waited for."""

_BITS_A_BYTE = 11
"""As Modbus has them: a start bit, 8 of data, parity and a stop bit, or two of these."""
_FRAME_BYTES = 64
"""More than any of the shaker's: its name is the longest answer, of some forty."""
_LEAST_S = 0.1
"""Of any device: an adapter on USB keeps bytes for 16 ms each way, a controller answers once in its cycle."""
_IN_A_HEARTBEAT = 5
"""An answer is lost on every line now and then. With two lost in a row, the third and what else is between
two beats, the next beat has still to be in time."""


def answer_time_s(baud: int, heartbeat_timeout_s: float) -> float:
    """Two frames at that speed, and a fifth of the time without a beat for the device to turn round."""
    frames_s = 2 * _FRAME_BYTES * _BITS_A_BYTE / baud
    return frames_s + max(_LEAST_S, heartbeat_timeout_s / _IN_A_HEARTBEAT)
