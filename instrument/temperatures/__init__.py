"""One law from several temperatures, each found by itself first; may use `finding` and all below it."""
