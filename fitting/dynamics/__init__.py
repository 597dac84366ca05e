"""How a plate moves, on all its degrees of freedom: modes, damping, response."""
