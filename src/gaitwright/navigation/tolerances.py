"""The order of tolerances: what plans, what checks and what moves take them from here, and from nowhere else.

A plan keeps more room than a check asks for, and a check more than a motion or a collision: else a robot
refuses its own plan a millimetre before a wall, for ever. Clearance of a disc of radius r [m], falling:
nodes r + `NODE` > links r − `LINK` > stop of a motion r − `STOP` > check of a path r − `CHECK` > collision
r − `TOUCH`.
"""

import math

NODE = 1e-4
"""Nodes stand this much farther than r from the piece they turn around [m]."""
LINK = 1e-7
"""A link may come this much nearer than r [m], so that one may run along a wall."""
STOP = 5e-4
"""A motion stops before it comes this much nearer than r [m]."""
CHECK = 6e-4
"""A path is cut by what comes this much nearer than r [m]."""
TOUCH = 1e-3
"""A body that comes this much nearer than r has touched [m]."""
HALF_STEP = math.radians(15.0)
"""Half the angle between two nodes around an end: a way may need a disc of r / cos of it, no more."""
LEAN = 1e-3
"""A link may lean this much more than half a step from the tangent of its nodes [rad]."""
DEEP = 0.5
"""Whatever is believed to be nearer than this share of r to the robot's own place is not there."""
WORTH = 1.05
"""A way over known ground is taken when it is at most this much longer than the shortest that may exist."""
