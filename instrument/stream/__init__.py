"""The one stream: what happened, in order. Live, simulated and recorded runs produce the same events."""
