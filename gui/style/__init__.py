"""How the window looks: colours, size of type, edges, signs. On nothing else of `gui`."""
