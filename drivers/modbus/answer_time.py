"""How long an answer on a serial line is waited for, and how long one that is late is listened for."""

_BITS_A_BYTE = 11
"""As Modbus has them: a start bit, 8 of data, parity and a stop bit, or two of these."""
_FRAME_BYTES = 64
"""More than any of the shaker's: its name is the longest answer, of some forty."""
_LEAST_S = 0.1
"""Of any device: an adapter on USB keeps bytes for 16 ms each way, a controller answers once in its cycle."""
_IN_A_HEARTBEAT = 5
"""An answer is lost on every line now and then. With two lost in a row, what they are listened for, and a
third that comes at once, the next beat is in time where the heartbeat is long beside the frames: from 0.7 s
at 115200 baud, from 1.9 s at 9600. With one lost it is from 0.5 s and 0.8 s."""
_PATIENCE_IN_A_HEARTBEAT = 4
"""What a fifth each for two attempts leaves room for."""


def answer_time_s(baud: int, heartbeat_timeout_s: float) -> float:
    """Two frames at that speed, and a fifth of the time without a beat for the device to turn round."""
    frames_s = 2 * _FRAME_BYTES * _BITS_A_BYTE / baud
    return frames_s + max(_LEAST_S, heartbeat_timeout_s / _IN_A_HEARTBEAT)


def patience_s(heartbeat_timeout_s: float) -> float:
    """Beyond the time-outs, for all in a row that never come: they might yet, and pass for the next one's."""
    return heartbeat_timeout_s / _PATIENCE_IN_A_HEARTBEAT
