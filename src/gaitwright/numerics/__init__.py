"""Compiled kernels, geometry, matrices, curves and small solvers: numbers that know no robot."""
