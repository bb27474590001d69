"""Areas of which most stays where it is: that stands still, and only the difference moves."""
