"""Output formats: a movement to the file of an ending, by one table of writers."""
