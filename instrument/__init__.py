"""The instrument: what is measured, in which order, what it means and where it is kept."""
