"""Natural frequencies and loss factors of single modes as data: any structure, identified and diagnosed."""
