"""What commands, files and figures say of a result."""
