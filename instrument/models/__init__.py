"""Models of a specimen, made, kept on disk and lent; may use what files and sessions hold, finds no law."""
