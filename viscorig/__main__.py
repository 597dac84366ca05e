"""`python -m viscorig`: the same command without its script."""

from instrument.cli.main import main

main()
