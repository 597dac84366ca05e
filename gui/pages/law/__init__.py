"""The core's law as pages show it: its curves and its numbers at some frequencies."""
