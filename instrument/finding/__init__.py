"""Laws and causes found in files or tables of modes; may use `models`, `remarks` and `mistakes`."""
