"""Robot + motion ↔ forces: Newton–Euler, articulated bodies, Armstrong's recursion, closed chains."""
