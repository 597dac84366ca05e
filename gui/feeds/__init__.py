"""Where a picture's events come from: a run in its engine, or a recorded session."""
