"""What single steps of a sweep would teach about the core's law, and which to take next. Linear, and pure."""
