"""Items without a partner: how each disappears, or appears as one would disappear backwards."""
