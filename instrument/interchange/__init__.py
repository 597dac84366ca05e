"""What a session holds, gathered; its data to other programs' files, and theirs to ours."""
