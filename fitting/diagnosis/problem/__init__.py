"""One set of data: all that no candidate changes, and what its model and its instruments get wrong."""
