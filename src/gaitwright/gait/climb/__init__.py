"""Scene + Robot → a planned climb, one foot at a time (thesis, section 6.3)."""
