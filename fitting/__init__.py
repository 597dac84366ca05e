"""The fitting: plate, core laws, response and identification.

Arrays and small frozen dataclasses in, the same out: no file, no clock, no screen.
"""
