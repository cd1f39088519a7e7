"""A teacher's words → a rulebook: school, lessons in person, own mistakes, joined books (§5.4.2, §6.4)."""
