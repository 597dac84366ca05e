"""A plate on a few motions, certified, and its response as a sum rational in G*."""
