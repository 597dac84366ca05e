"""What a person can have done, and what came of it. It asks by `widgets`, and knows no page and no bar."""
