"""Which explanations the data support, what is in no catalogue, and what is said of it."""
