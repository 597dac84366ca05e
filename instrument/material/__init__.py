"""A material's law wherever it was found: in a session, in the JSON of a command."""
