"""What there is to stand on: terrain, scenes and where feet may stand."""
