"""The hammer test: blows caught from the stream, judged, accepted or not, and the plate's modes from them."""
