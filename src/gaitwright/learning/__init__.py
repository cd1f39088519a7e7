"""A teacher's trips → a rulebook: the critic, the apprentice that watches, and the school (§5.4.2, §6.4)."""
