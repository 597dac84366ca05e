"""Many sessions or sweeps, one row each: here, or on a Dask cluster."""
