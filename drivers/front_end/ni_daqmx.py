"""NI devices through NI-DAQmx: an optional way in, not tried on hardware.

One rule: nothing of NI's is imported until a driver is made. It needs NI's own driver and `pip install
"viscorig[ni]"`; where either is absent that is said in one line.

A fed sensor is read as a voltage with current excitation, so that every channel is in volts and the sensor's
sensitivity stays in the rig file. Samples are read unscaled, as the converters gave them.
"""

from contextlib import suppress
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drivers.errors import DriverError, Missing, Refused, TimedOut
from drivers.front_end.interface import Block, InputChannel

_IEPE_CURRENT_A = 0.002
_BUFFER_S = 10.0
"""How long the host's buffer lasts when nobody reads."""


class NiDaqmxFrontEnd:
    """A `FrontEnd`.

    Parameters
    ----------
    device
        As NI's configuration names it: `cDAQ1Mod1`. Channel 1 is its `ai0`.
    timeout_s
        For the samples of one `read` beyond the time that they take.

    Raises
    ------
    Missing, Refused
    """

    def __init__(self, device: str, *, timeout_s: float = 5.0) -> None:
        self._nidaqmx = _library()
        self._device_name, self._timeout_s = device, timeout_s
        self._task: Any = None
        self._sample_rate_hz = 0.0
        self._taken = 0
        try:
            self._device = self._nidaqmx.system.Device(device)
            self._identity = f"{self._device.product_type}, serial number {self._device.serial_num:08X}"
        except self._nidaqmx.errors.Error as error:
            raise self._failed(error) from error

    @property
    def sample_rate_hz(self) -> float:
        """As the device runs, after `start`."""
        return self._sample_rate_hz

    def identity(self) -> str:
        """Model and serial number, as the device states them."""
        return self._identity

    def start(self, channels: tuple[InputChannel, ...], sample_rate_hz: float) -> None:
        """Begin to sample. Refused where the device runs at another rate than asked, naming its own."""
        if self._task is not None:
            raise Refused(f"{self._me}: it is sampling: stop it first")
        try:
            self._task = self._nidaqmx.Task()
            self._inputs = [self._add(channel) for channel in channels]
            self._set_clock(sample_rate_hz)
            self._reader = self._nidaqmx.stream_readers.AnalogUnscaledReader(self._task.in_stream)
            self._scale = [self._scaling(one) for one in self._inputs]
            self._task.start()
        except self._nidaqmx.errors.Error as error:
            self._release()
            raise self._failed(error) from error
        except DriverError:
            self._release()
            raise
        self._taken = 0

    def read(self, samples: int) -> Block:
        """The next `samples` of each channel, none lost, or a `DriverError`."""
        if self._task is None:
            raise Refused(f"{self._me}: it is not sampling: start it first")
        raw = np.empty((len(self._inputs), samples), np.int32)
        try:
            self._reader.read_int32(raw, samples, self._timeout_s + samples / self._sample_rate_hz)
            overloaded = self._named("overloaded_chans")
            opened = self._named("open_chans")
        except self._nidaqmx.errors.Error as error:
            raise self._failed(error) from error
        return self._block(raw, overloaded, opened)

    def stop(self) -> None:
        """End sampling. Works in any state, also twice."""
        self._release()

    def close(self) -> None:
        """Let go of the device."""
        self._release()

    @property
    def _me(self) -> str:
        return f"front-end {self._device_name}"

    def _add(self, channel: InputChannel) -> Any:
        constants = self._nidaqmx.constants
        one = self._task.ai_channels.add_ai_voltage_chan(
            f"{self._device_name}/ai{channel.number - 1}", min_val=-channel.range_v, max_val=channel.range_v
        )
        if channel.iepe:
            one.ai_coupling = constants.Coupling.AC
            one.ai_excit_src = constants.ExcitationSource.INTERNAL
            one.ai_excit_voltage_or_current = constants.ExcitationVoltageOrCurrent.USE_CURRENT
            one.ai_excit_val = _IEPE_CURRENT_A
        return one

    def _set_clock(self, sample_rate_hz: float) -> None:
        timing = self._task.timing
        timing.cfg_samp_clk_timing(
            sample_rate_hz,
            sample_mode=self._nidaqmx.constants.AcquisitionType.CONTINUOUS,
            samps_per_chan=int(_BUFFER_S * sample_rate_hz),
        )
        self._sample_rate_hz = float(timing.samp_clk_rate)
        if abs(self._sample_rate_hz - sample_rate_hz) > 1e-6 * sample_rate_hz:
            own_hz = self._sample_rate_hz
            raise Refused(f"{self._me}: {sample_rate_hz:g} Hz is no rate of it: the nearest is {own_hz!r} Hz")

    def _scaling(self, one: Any) -> tuple[float, int, float]:
        """Volts a count, the offset in counts and the full scale in volts."""
        coefficients = [*one.ai_dev_scaling_coeff, 0.0, 0.0]
        offset_v, volts_per_count = coefficients[0], coefficients[1]
        # A block knows no offset; to half a count it is put into the counts.
        return volts_per_count, round(offset_v / volts_per_count), float(one.ai_rng_high)

    def _named(self, attribute: str) -> set[str]:
        """Channels the device reports, none where it does not watch for it."""
        stream = self._task.in_stream
        with suppress(self._nidaqmx.errors.Error):
            if getattr(stream, f"{attribute}_exist"):
                return set(getattr(stream, attribute))
        return set()

    def _block(self, raw: NDArray[np.int32], overloaded: set[str], opened: set[str]) -> Block:
        volts_per_count, offsets, full_scale_v = (
            np.array(column) for column in zip(*self._scale, strict=True)
        )
        counts = raw + offsets.astype(np.int32)[:, None]
        volts = np.abs(counts).max(axis=1) * volts_per_count
        names = [one.name for one in self._inputs]
        first, self._taken = self._taken, self._taken + raw.shape[1]
        return Block(
            first_sample=first,
            counts=counts,
            volts_per_count=volts_per_count,
            full_scale_v=full_scale_v,
            overload=np.array([name in overloaded for name in names]) | (volts >= full_scale_v),
            cable_fault=np.array([name in opened for name in names]),
        )

    def _release(self) -> None:
        task, self._task = self._task, None
        if task is not None:
            with suppress(self._nidaqmx.errors.Error):
                task.close()

    def _failed(self, error: Exception) -> DriverError:
        """NI's messages have many lines; the first and the code say it."""
        code = getattr(error, "error_code", 0)
        text = " ".join(str(error).split("\n")[0].split())
        kind = TimedOut if code == _TIMEOUT_CODE else Missing if _is_missing(error) else DriverError
        return kind(f"{self._me}: {text} ({code})")


_TIMEOUT_CODE = -200284
"""Some or all of the samples asked for have not been acquired in time."""


def _is_missing(error: Exception) -> bool:
    return type(error).__name__ in ("DaqNotFoundError", "DaqNotSupportedError")


def _library() -> ModuleType:
    try:
        library = import_module("nidaqmx")
        for part in ("constants", "errors", "stream_readers", "system"):
            import_module(f"nidaqmx.{part}")
    except ImportError as error:
        raise Missing(
            f'NI-DAQmx: {error}: run pip install "viscorig[ni]" and install NI\'s driver'
        ) from error
    return library
