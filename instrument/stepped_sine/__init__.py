"""The stepped sine: which frequency next, at which drive, when it has settled, what it reads. Pure."""
