"""The studio: a page on this machine that shows a matching, lets it be set right, and saves it."""
