"""Robots that come with Gaitwright, as mesh-free MJCF files in this folder."""

from pathlib import Path

ROBOTS = {
    "go2": "Unitree Go2, a 15 kg quadruped: abduction, hip pitch, knee",
    "thesis": "the robot of the thesis with physical masses (10 kg, legs of 5 m): yaw, elevation, knee",
    "thesis-table": "the robot of the thesis as heavy as its Table 6.2 says (18.8 kg)",
    "hexapod": "a 3 kg servo hexapod of our own: yaw, elevation, knee",
}
"""Built-in robots: name → one line about it."""


def robot_names() -> tuple[str, ...]:
    """Names that `load_robot` knows."""
    return tuple(ROBOTS)


def robot_file(name: str) -> Path:
    """The MJCF file of a built-in robot."""
    return Path(__file__).with_name(f"{name}.xml")
