"""An experiment before it is run."""
