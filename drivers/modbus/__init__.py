"""One Modbus connection, whatever device is on it."""
