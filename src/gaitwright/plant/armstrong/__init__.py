"""MotorCommand → Measured by Armstrong's recursion: ball joints held by springs (rows N6 … N8)."""
