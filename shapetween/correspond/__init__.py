"""Finding which point of one outline becomes which point of the other."""
