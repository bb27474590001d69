"""A movement as one page with a player, which needs nothing but a browser."""
