"""What is always seen: how a run stands and STOP, a recording's player. On `actions`, and knows no page."""
