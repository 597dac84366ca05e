"""The session: everything that happened, kept so that nothing complete is ever lost."""
