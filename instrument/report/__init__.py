"""A session as one page: blocks of sentences, tables and figures, rendered without a network."""
