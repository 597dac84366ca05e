"""Law, stated numbers and effects fitted together, and how well each is known then."""
