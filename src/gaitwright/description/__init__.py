"""MJCF or URDF → Robot, in a process of its own: the file is never trusted."""
