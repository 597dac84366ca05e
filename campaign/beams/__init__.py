"""A campaign on beams: solid ones, shaken or struck, that hide what a diagnosis shall find."""
