"""Model discrepancy: how far the layer-wise plate is from exact elasticity, and its mesh from itself."""
