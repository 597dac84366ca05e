"""A vibrometer that does not exist: where a driver begins."""
