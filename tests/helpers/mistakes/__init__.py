"""Mistakes a new user makes: what is done to valid files, the command, and what its one line has to say."""
