"""What stages know of the world: robots, terrains, kinematics and dynamics."""
