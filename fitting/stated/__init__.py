"""What a specimen is stated to be made of: layers, patches, edges; how well each number is known."""
