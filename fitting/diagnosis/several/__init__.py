"""Several files, spots and specimens under one law, as one problem; effects among them."""
