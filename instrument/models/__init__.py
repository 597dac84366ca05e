"""Models of a specimen, kept on disk, and what is identified and diagnosed with them."""
