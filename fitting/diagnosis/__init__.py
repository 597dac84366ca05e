"""What a fit cannot explain, traced to an effect the plate model lacks."""
