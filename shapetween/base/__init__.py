"""What everything else stands on: arrays, errors, observers, threads, the version."""
