"""What a plant can be asked for, by name. Imports nothing: the command line's help reads it."""

PLANTS = {
    "mujoco": "hinges and contacts by MuJoCo",
    "armstrong": "the thesis's: ball joints held by springs, by Armstrong's recursion",
}
"""Simulated worlds: name → what it is."""

INTEGRATORS = {
    "euler": "the thesis's, which needs the shortest steps",
    "semi-implicit": "velocities first, then positions: the cheapest that lasts",
    "rk4": "order 4, four evaluations a step",
    "adaptive": "order 3, step by step as long as the accuracy allows",
}
"""How plant `armstrong` steps through time: name → what it is."""
