"""Do identification and diagnosis hold on other plates? Many solids, each told as a careful lab knows it."""
