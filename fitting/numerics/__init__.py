"""Mathematics that knows of no plate: sparse factors, chances, robust scatter."""
