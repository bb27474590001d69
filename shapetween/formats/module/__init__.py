"""A movement as a JavaScript module: path data at any time, and a player, in a few kilobytes."""
