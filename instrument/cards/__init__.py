"""Material cards: a law in the form that a program for simulation reads."""
