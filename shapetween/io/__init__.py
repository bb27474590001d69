"""Files, strict JSON, linked pictures and progress: what touches the machine."""
