"""What a command or a function says, without how long it took."""

SECONDS = {"seconds", "setup_seconds", "validation_seconds"}


def timeless(facts):
    return {key: value for key, value in facts.items() if key not in SECONDS}
