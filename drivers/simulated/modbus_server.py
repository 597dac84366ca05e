"""A simulated device on the wire: Modbus TCP on the loopback, Modbus RTU on a pseudo-terminal.

Holding registers only. What the device refuses comes back as NEGATIVE_ACKNOWLEDGE, numbers that cannot be as
ILLEGAL_VALUE, registers that are not there or not to be written as ILLEGAL_ADDRESS.
"""

import asyncio
import logging
import threading
from collections.abc import AsyncIterator
from contextlib import AsyncExitStack, asynccontextmanager, suppress
from dataclasses import dataclass
from types import TracebackType
from typing import Protocol

from pymodbus.constants import ExcCodes
from pymodbus.server import ModbusSerialServer, ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice

from drivers.errors import DriverError, Garbled, Refused, TimedOut, Unreachable
from drivers.simulated.pseudo_terminals import PseudoTerminals

logging.getLogger("pymodbus").addHandler(logging.NullHandler())

BAUD = 115200
WATCH_S = 0.05
START_TIMEOUT_S = 5.0
STOP_TIMEOUT_S = 5.0

_READ, _WRITE_ONE, _WRITE, _MASK, _READ_WRITE = 3, 6, 16, 22, 23


@dataclass(frozen=True)
class RegisterBlock:
    """Registers in a row that belong together."""

    address: int
    width: int
    writable: bool


class ServedRegisters(Protocol):
    """A device as a master sees it: words at addresses. Called with the server's lock held."""

    def blocks(self) -> list[RegisterBlock]:
        """All there are."""
        ...

    def words(self) -> dict[int, int]:
        """Every word by its address, as of this moment."""
        ...

    def write(self, address: int, new: list[int]) -> None:
        """Words from a master.

        Raises
        ------
        Garbled
            Numbers that cannot be.
        Refused
            The device said no.
        """
        ...

    def watch(self) -> None:
        """Called every `WATCH_S`, whether or not anybody is connected."""
        ...


class ModbusServer:
    """Serves a device from a thread of its own; a context manager.

    Parameters
    ----------
    name
        Of the device, for messages.
    lock
        Held for every touch of the device.
    port
        Of Modbus TCP on 127.0.0.1; 0: a free one.
    rtu
        Serve Modbus RTU too, at `rtu_path`.
    """

    def __init__(
        self,
        served: ServedRegisters,
        name: str,
        *,
        lock: threading.RLock,
        port: int = 0,
        rtu: bool = False,
        unit: int = 1,
    ) -> None:
        self._served = served
        self._name = name
        self._lock = lock
        self._port = port
        self._rtu = rtu
        self._unit = unit
        self._thread: threading.Thread | None = None
        self._ready = threading.Event()
        self._failure: BaseException | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._ending: asyncio.Event | None = None
        self.address: tuple[str, int] = ("127.0.0.1", port)
        """Of Modbus TCP, after `start`."""
        self.rtu_path: str | None = None
        """Serial port of Modbus RTU, after `start`."""

    def start(self) -> None:
        """Serve.

        Raises
        ------
        Unreachable
            The port is taken.
        """
        self._ready.clear()
        self._failure = None
        self._thread = threading.Thread(target=self._run, name=self._name, daemon=True)
        self._thread.start()
        if not self._ready.wait(START_TIMEOUT_S):
            raise TimedOut(f"{self._name} at port {self._port}: not serving within {START_TIMEOUT_S:g} s")
        if self._failure is not None:
            self._thread.join(STOP_TIMEOUT_S)
            self._thread = None
            raise Unreachable(
                f"{self._name}: cannot serve at 127.0.0.1:{self._port}: {self._failure}"
            ) from self._failure

    def stop(self) -> None:
        """End serving and drop every connection; also twice. The device stays as it is.

        Raises `TimedOut` where it serves on, `DriverError` for what made serving fail before.
        """
        if self._thread is None:
            return
        if self._loop is not None and self._ending is not None:
            # The loop may have ended by a failure of its own.
            with suppress(RuntimeError):
                self._loop.call_soon_threadsafe(self._ending.set)
        self._thread.join(STOP_TIMEOUT_S)
        if self._thread.is_alive():
            raise TimedOut(f"{self._name} at {self.address}: still serving after {STOP_TIMEOUT_S:g} s")
        self._thread = None
        if self._failure is not None:
            raise DriverError(f"{self._name} at {self.address}: {self._failure}") from self._failure

    def __enter__(self) -> "ModbusServer":
        self.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.stop()

    def _run(self) -> None:
        try:
            asyncio.run(self._serve())
        except BaseException as failure:
            # Told by `start` or `stop`, on the caller's thread.
            self._failure = failure
        finally:
            self._ready.set()

    async def _serve(self) -> None:
        self._loop, self._ending = asyncio.get_running_loop(), asyncio.Event()
        async with AsyncExitStack() as stack:
            self.address = await stack.enter_async_context(self._tcp())
            # Served again, it is found where it was.
            self._port = self.address[1]
            if self._rtu:
                self.rtu_path = await stack.enter_async_context(self._serial())
            self._ready.set()
            while not self._ending.is_set():
                with self._lock:
                    self._served.watch()
                with suppress(TimeoutError):
                    await asyncio.wait_for(self._ending.wait(), WATCH_S)

    @asynccontextmanager
    async def _tcp(self) -> AsyncIterator[tuple[str, int]]:
        server = ModbusTcpServer(self._sim_device(), address=("127.0.0.1", self._port))
        await server.serve_forever(background=True)
        try:
            host, port = server.transport.sockets[0].getsockname()  # type: ignore[attr-defined]
            yield host, port
        finally:
            await _shut_down(server)

    @asynccontextmanager
    async def _serial(self) -> AsyncIterator[str]:
        terminals = PseudoTerminals(asyncio.get_running_loop())
        try:
            server = ModbusSerialServer(self._sim_device(), port=terminals.device_path, baudrate=BAUD)
            await server.serve_forever(background=True)
            try:
                yield terminals.master_path
            finally:
                await _shut_down(server)
        finally:
            terminals.close()

    def _sim_device(self) -> SimDevice:
        data = [
            SimData(b.address, count=b.width, values=0, datatype=DataType.REGISTERS, readonly=not b.writable)
            for b in self._served.blocks()
        ]
        return SimDevice(id=self._unit, simdata=data, action=self._serve_request)

    async def _serve_request(
        self,
        function: int,
        start_address: int,
        address: int,
        count: int,
        current: list[int],
        new: list[int] | list[bool] | None,
    ) -> ExcCodes | None:
        """Pymodbus calls it before it answers from `current`, which begins at `start_address`."""
        if function not in (_READ, _WRITE_ONE, _WRITE, _MASK, _READ_WRITE):
            return ExcCodes.ILLEGAL_FUNCTION
        # A single write is answered with the word as written, even where it reads back differently.
        if function == _WRITE_ONE and new is None:
            return None
        try:
            with self._lock:
                if new is not None:
                    self._served.write(address, [int(word) for word in new])
                for at, word in self._served.words().items():
                    current[at - start_address] = word
        except Garbled:
            return ExcCodes.ILLEGAL_VALUE
        except Refused:
            return ExcCodes.NEGATIVE_ACKNOWLEDGE
        return None


async def _shut_down(server: ModbusTcpServer | ModbusSerialServer) -> None:
    await server.shutdown()  # type: ignore[no-untyped-call]
    # Closed transports say goodbye in the next turns of the loop.
    for _ in range(3):
        await asyncio.sleep(0)
