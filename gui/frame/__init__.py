"""The window and what is arranged around the pages. On all of `gui` but what starts the program."""
