"""The reduced plate widened by the motions that effects stir, and what an effect may change of it."""
