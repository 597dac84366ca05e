"""Nuisance parameters: stated numbers, and narrow resonances, as unknowns of a fit."""
