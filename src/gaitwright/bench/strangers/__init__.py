"""A folder of anybody's files → those that are whole robots, and how many legs each says it has."""
