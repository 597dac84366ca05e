"""A form for a file, made from the file's own model: fields, units, ranges and faults are the model's."""
