"""What is said of data, specimen and theory beside a result; may use `models`, not `mistakes`."""
