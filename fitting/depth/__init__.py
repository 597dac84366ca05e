"""How well a law is known beyond the linear errors: profiles, a sampled posterior, a bootstrap."""
