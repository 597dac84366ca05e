"""The window. Qt lives here and nowhere else.

Empty so far: the command line does all there is.
"""
