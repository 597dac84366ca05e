"""What is known of files that a person chose. Without Qt, on nothing else of `gui`."""
