"""Modbus transactions, each bounded in time, over a connection that is made again where it is lost.

One transaction at a time, in the order of arrival, and between two attempts the line is free: so a stop asked
on another thread waits for one attempt at most, and on a serial line for what an answer still owed takes.
"""

import logging
import struct
import time
from collections.abc import Callable, Sequence

from pymodbus.client import ModbusTcpClient
from pymodbus.constants import ExcCodes
from pymodbus.exceptions import ConnectionException, ModbusIOException
from pymodbus.pdu import ModbusPDU
from pymodbus.pdu.register_message import ReadHoldingRegistersResponse, WriteMultipleRegistersResponse

from drivers.errors import DriverError, Garbled, Refused, TimedOut, Unreachable
from drivers.modbus.fair_lock import FairLock
from drivers.modbus.heard import Heard
from drivers.modbus.owed import Owed
from drivers.modbus.serial_client import SerialClient, why_not_open

# What goes wrong is raised, in one line; the library's own log is for those who ask for it.
logging.getLogger("pymodbus").addHandler(logging.NullHandler())

FIRST_PAUSE_S = 0.05
"""Before the second attempt; it doubles with each further one."""


class ModbusLine:
    """A device on a Modbus connection. Opens when first used.

    A transaction takes at most (retries + 1) x 3 timeout_s (connect, and an answer that trickles in) and the
    pauses between the attempts, on a serial line `patience_s` more for each. Repeating one must do no harm:
    an answer may be lost after the deed.
    """

    def __init__(
        self,
        client: ModbusTcpClient | SerialClient,
        name: str,
        *,
        unit: int,
        timeout_s: float,
        retries: int,
        heard: Heard | None = None,
        settings: str = "",
        patience_s: float = 0.0,
    ) -> None:
        """`client` passes its packets through `heard`; `settings` are what a serial line may have wrong.

        `patience_s` is how long such a line is listened to for lost answers, beyond their time-outs.
        """
        self.name = name
        """Device and address, for messages."""
        self.lost_answers = 0
        """That did not come, or damaged, so far; those asked for again with success included."""
        self._client = client
        self._unit = unit
        self._timeout_s = timeout_s
        self._heard = heard or Heard()
        self._settings = settings
        self._owed = Owed(patience_s)
        self._attempts = retries + 1
        self._lock = FairLock()

    @classmethod
    def tcp(
        cls, device: str, host: str, port: int, *, unit: int, timeout_s: float, retries: int
    ) -> "ModbusLine":
        """Modbus TCP; messages begin with `device`."""
        heard = Heard()
        client = ModbusTcpClient(host, port=port, timeout=timeout_s, retries=0, trace_packet=heard)
        name = f"{device} at {host}:{port} unit {unit}"
        return cls(client, name, unit=unit, timeout_s=timeout_s, retries=retries, heard=heard)

    @classmethod
    def rtu(
        cls,
        device: str,
        port: str,
        *,
        baud: int,
        parity: str,
        stop_bits: int,
        unit: int,
        timeout_s: float,
        retries: int,
        patience_s: float,
    ) -> "ModbusLine":
        """Modbus RTU on a serial port, 8 data bits; messages begin with `device`.

        Before anything is sent after a lost answer, that is listened for `patience_s`.
        """
        heard = Heard()
        client = SerialClient(
            port,
            baudrate=baud,
            parity=parity,
            stopbits=stop_bits,
            timeout=timeout_s,
            retries=0,
            trace_packet=heard,
        )
        return cls(
            client,
            f"{device} at {port} unit {unit}",
            unit=unit,
            timeout_s=timeout_s,
            retries=retries,
            heard=heard,
            settings=f"baud ({baud}), parity ({parity}), stop bits ({stop_bits}) and unit ({unit})",
            patience_s=patience_s,
        )

    def read(self, what: str, address: int, count: int) -> list[int]:
        """Holding registers; `what` is for messages.

        Raises
        ------
        Unreachable, TimedOut, Garbled
            As the last attempt ended.
        Refused
            The device answered with a Modbus exception.
        """
        answer = self._transact(
            f"reading {what}",
            lambda: self._client.read_holding_registers(address, count=count, device_id=self._unit),
            lambda found: _read_objection(found, address, count),
        )
        return list(answer.registers)

    def write(self, what: str, address: int, words: Sequence[int]) -> None:
        """Holding registers, in one piece. Raises as `read` does."""
        self._transact(
            f"writing {what}",
            lambda: self._client.write_registers(address, list(words), device_id=self._unit),
            lambda found: _write_objection(found, address, len(words)),
        )

    def close(self) -> None:
        """Let go of the connection; a later transaction opens it again."""
        with self._lock:
            self._client.close()  # type: ignore[no-untyped-call]

    def _transact(
        self, what: str, ask: Callable[[], ModbusPDU], object_to: Callable[[ModbusPDU], str]
    ) -> ModbusPDU:
        """`object_to` says why what came is no answer to this; nothing where it is one."""
        for attempt in range(self._attempts):
            if attempt:
                time.sleep(FIRST_PAUSE_S * 2 ** (attempt - 1))
            with self._lock:
                try:
                    answer = self._once(what, ask, object_to)
                except Refused:
                    self._owed.row_ended()
                    raise
                except Unreachable as problem:
                    self._client.close()  # type: ignore[no-untyped-call]
                    last: DriverError = problem
                except (TimedOut, Garbled) as problem:
                    self.lost_answers += 1
                    self._lose(is_last=attempt == self._attempts - 1)
                    last = problem
                except BaseException:
                    # Broken off by a signal: the answer that is still to come is nobody's.
                    self._lose(is_last=False)
                    self._owed.row_ended()
                    raise
                else:
                    self._owed.row_ended()
                    return answer
        self._owed.row_ended()
        raise last

    def _lose(self, *, is_last: bool) -> None:
        """A new connection knows no old answer; a serial port stays open to hear it, for a retry's sake."""
        self._owed.lost()
        if is_last or not isinstance(self._client, SerialClient):
            self._client.close()  # type: ignore[no-untyped-call]

    def _once(
        self, what: str, ask: Callable[[], ModbusPDU], object_to: Callable[[ModbusPDU], str]
    ) -> ModbusPDU:
        here = f"{self.name}, {what}"
        tried = f"in each of {self._attempts} attempts"
        try:
            connected = self._client.connect()
        except OSError as problem:
            raise Unreachable(f"{here}: {why_not_open(problem, tried)}") from problem
        if not connected:
            raise Unreachable(
                f"{here}: no connection within {self._timeout_s:g} s {tried}: check power, cable and address"
            )
        self._heard.forget()
        try:
            if isinstance(self._client, SerialClient):
                self._owed.settle(self._client)
            answer = ask()
        except (ConnectionException, OSError) as problem:
            raise Unreachable(f"{here}: the connection was lost {tried}: {problem}") from problem
        except ModbusIOException as problem:
            if "No response" in str(problem):
                raise self._unanswered(here, tried) from problem
            raise Garbled(f"{here}: a Modbus answer expected: {problem}") from problem
        except struct.error as problem:
            raise Garbled(f"{here}: a Modbus answer expected: {problem}") from problem
        if answer.isError():
            raise Refused(f"{here}: refused with {_exception_name(answer)}")
        if objection := object_to(answer):
            raise Garbled(f"{here}: {objection} {tried}")
        return answer

    def _unanswered(self, here: str, tried: str) -> TimedOut | Garbled:
        check = f"check cable, {self._settings}" if self._settings else ""
        if damaged := self._heard.damaged:
            return Garbled(f"{here}: an answer expected, {damaged}, {tried}: {check or 'check the cable'}")
        silent = f"none came within {self._timeout_s:.2g} s {tried}"
        return TimedOut(f"{here}: an answer expected, {silent}: {check or f'is its unit {self._unit}?'}")


# A serial line numbers nothing: a late answer to another question must not pass for this one's.


def _read_objection(found: ModbusPDU, address: int, count: int) -> str:
    if not isinstance(found, ReadHoldingRegistersResponse):
        return "registers expected, another's answer came"
    came = len(found.registers)
    return "" if came == count else f"{count} registers from {address} expected, {came} came"


def _write_objection(found: ModbusPDU, address: int, count: int) -> str:
    right = isinstance(found, WriteMultipleRegistersResponse)
    if right and (found.address, found.count) == (address, count):
        return ""
    return f"the receipt of {count} registers from {address} expected, another's came"


def _exception_name(answer: ModbusPDU) -> str:
    code = answer.exception_code
    name = ExcCodes(code).name if code in tuple(ExcCodes) else "unknown"
    return f"Modbus exception {code} ({name})"
