"""Does a diagnosis find what is there? Simulated cases that hide effects, diagnosed and scored."""
