"""From a measured sweep to the core's law, by two methods that return one kind of result."""
