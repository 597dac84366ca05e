"""The simulated rig: instruments that speak their real protocols, driven by one plant. No part of a fit."""
