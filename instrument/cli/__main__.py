"""`python -m instrument.cli`: the same command without its script."""

from instrument.cli.main import main

main()
