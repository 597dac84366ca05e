"""Where the session state's events come from: a run in its engine, or a recorded session."""
