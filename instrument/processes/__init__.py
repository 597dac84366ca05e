"""Work in other processes, and processes that let others go first; of `instrument` uses only `errors`."""
