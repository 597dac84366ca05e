"""Small widgets, and questions to a person, that know of no session. On `style` alone."""
