"""Mistakes in data or specimen, asked about before a result is believed; may use `models`, not `remarks`."""
