"""The drivers: shaker, vibrometer, front-end and chamber. Bytes to messages, and the devices that carry them.

A folder a kind of device: `interface.py` says what the program needs of it, a protocol file holds bytes and
commands without I/O, a `..._driver.py` its table in RIG.toml and what opens it (docs/plugins.md). `modbus/`
is a connection that several kinds use; `simulated/` plays the devices on real wires. Nothing here knows of
fits, plans or sessions.
"""
