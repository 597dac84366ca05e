"""What a sweep reads under a law, stated numbers and effects, with derivatives."""
