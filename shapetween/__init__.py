"""Turn two vector drawings into the movement between them."""
