"""What a plant can be asked for, by name. Imports nothing: the command line's help reads it."""

PLANTS = {
    "mujoco": "hinges and contacts by MuJoCo",
    "armstrong": "the thesis's: ball joints held by springs, by Armstrong's recursion",
    "kinematic": "no mechanics: the robot is where its coordinator puts it",
}
"""Simulated worlds: name → what it is."""

INTEGRATORS = {
    "euler": "the thesis's, order 1, positions and velocities at once",
    "semi-implicit": "order 1, velocities first, then positions: gains less energy than euler",
    "rk4": "order 4, four evaluations a step, whose longest safe steps are little longer",
    "adaptive": "order 3, step by step as long as the accuracy allows",
}
"""How plant `armstrong` steps through time: name → what it is."""
