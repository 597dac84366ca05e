"""The drivers: shaker, vibrometer and front-end. Bytes to messages, and the devices that carry them.

Empty so far: the identification reads files.
"""
