"""Files at the border: read, checked as a whole, turned into the dataclasses of `fitting`."""
