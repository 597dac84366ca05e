"""What commands, runs and files say, typed: results as JSON holds them, and nothing that computes."""
