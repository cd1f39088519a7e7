"""Two skillbooks → one: nothing that either learned is lost."""
