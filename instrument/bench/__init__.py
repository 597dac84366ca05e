"""How fast the program is on this machine: what the reduced model buys, as ratios."""
