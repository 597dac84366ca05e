"""A core law, an effect and a vibrometer for viscorig; found by the entry points in pyproject.toml."""
