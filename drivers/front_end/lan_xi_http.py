"""What a LAN-XI module is asked over HTTP: answers whole, in bounded time and size, or a `DriverError`."""

import time
from collections.abc import Mapping
from typing import Any

import httpx

from drivers.errors import Garbled, Refused, TimedOut, Unreachable

_LONGEST_BODY = 1 << 22
"""Bytes: a set-up of twelve channels is a hundredth of it."""
_BODIES = 2.0
"""A whole answer may take so many times the time-out: one until it begins, one to arrive."""


class ModuleHttp:
    """The requests to one module; `me` is how errors call it."""

    def __init__(self, url: str, me: str, timeout_s: float, retries: int) -> None:
        self._me, self._timeout_s = me, timeout_s
        # Instruments sit on the local network: a proxy from the environment leads away from them. They
        # know no HTTPS, so there are no certificates to read.
        self._client = httpx.Client(
            base_url=f"{url}/rest/rec",
            timeout=timeout_s,
            transport=httpx.HTTPTransport(verify=False, retries=retries),
            trust_env=False,
        )

    @property
    def is_closed(self) -> bool:
        """Whether nothing more can be asked."""
        return self._client.is_closed

    def close(self) -> None:
        """Let go of the connection; also twice."""
        self._client.close()

    def json(self, path: str, **query: int) -> Any:
        """What the module says there. Raises `DriverError`."""
        response = self.request("GET", path, query=query)
        try:
            return response.json()
        except ValueError as error:
            raise Garbled(f"{self._me}: GET {path}: {response.text[:60]!r} is no JSON") from error

    def request(
        self, method: str, path: str, body: Any = None, query: Mapping[str, int] | None = None
    ) -> httpx.Response:
        """Its answer to one request. Raises `DriverError`."""
        what = f"{self._me}: {method} {path}"
        try:
            response = self._whole(what, method, path, body, query)
        except httpx.TimeoutException as error:
            raise TimedOut(f"{what}: no answer in {self._timeout_s:g} s") from error
        except httpx.RequestError as error:
            raise Unreachable(f"{what}: {error}: is the module switched on and in this network?") from error
        # A redirection is no yes: what was asked has not been done here.
        if not response.is_success:
            raise Refused(f"{what}: status {response.status_code}: {response.text.strip()[:100]}")
        return response

    def _whole(
        self, what: str, method: str, path: str, body: Any, query: Mapping[str, int] | None
    ) -> httpx.Response:
        """The answer with its body, which may neither trickle in for ever nor fill the memory."""
        deadline, content = time.monotonic() + _BODIES * self._timeout_s, bytearray()
        with self._client.stream(method, path, json=body, params=query) as response:
            for piece in response.iter_bytes():
                content += piece
                if len(content) > _LONGEST_BODY:
                    raise Garbled(f"{what}: over {_LONGEST_BODY} bytes came: is it a LAN-XI module?")
                if time.monotonic() > deadline:
                    raise TimedOut(f"{what}: no whole answer in {_BODIES * self._timeout_s:g} s")
        return httpx.Response(response.status_code, content=bytes(content))
