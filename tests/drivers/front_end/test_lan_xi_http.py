"""Answers of a module that are none: somewhere else, without end, too large."""

import socket
import threading
import time
from contextlib import contextmanager

import pytest

from drivers.errors import Garbled, Refused, TimedOut
from drivers.front_end.lan_xi_http import ModuleHttp

TIMEOUT_S = 0.3


@contextmanager
def server(answer):
    """Whatever is asked: the bytes that `answer()` yields."""
    with socket.create_server(("127.0.0.1", 0)) as listening:

        def serve():
            connection, _ = listening.accept()
            with connection:
                try:
                    connection.recv(4096)
                    for piece in answer():
                        connection.sendall(piece)
                except OSError:
                    return

        thread = threading.Thread(target=serve, daemon=True)
        thread.start()
        yield f"http://127.0.0.1:{listening.getsockname()[1]}"
        thread.join(5.0)


def ask(url):
    return ModuleHttp(url, "front-end", TIMEOUT_S, 0).json("/module/info")


def test_a_redirection_is_no_yes():
    def elsewhere():
        yield b"HTTP/1.1 302 Found\r\nLocation: http://127.0.0.1:9/\r\nContent-Length: 2\r\n\r\n{}"

    with server(elsewhere) as url, pytest.raises(Refused, match="status 302"):
        ask(url)


def test_a_body_that_trickles_in_ends_in_bounded_time():
    never = threading.Event()

    def trickle():
        yield b"HTTP/1.1 200 OK\r\nContent-Length: 100000\r\n\r\n"
        while True:
            never.wait(TIMEOUT_S / 6)
            yield b" "

    began = time.monotonic()
    with server(trickle) as url, pytest.raises(TimedOut, match="no whole answer"):
        ask(url)
    assert time.monotonic() - began < 10 * TIMEOUT_S


def test_a_body_without_end_does_not_fill_the_memory():
    sent = []

    def flood():
        yield b"HTTP/1.1 200 OK\r\nContent-Length: 1000000000\r\n\r\n"
        while True:
            sent.append(1)
            yield b"[" * (1 << 20)

    with server(flood) as url, pytest.raises(Garbled, match="bytes came"):
        ask(url)
    assert len(sent) < 100
