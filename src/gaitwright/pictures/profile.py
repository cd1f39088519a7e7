"""A torque profile as a picture: torques, angles and forces of each leg over the phase, stance shaded."""

from pathlib import Path

import numpy as np
from matplotlib.axes import Axes

from gaitwright.control.learned.profile import BINS, ROW, Profile
from gaitwright.files import whole
from gaitwright.model.robot import Robot
from gaitwright.pictures import Sheet
from gaitwright.pictures.style import INK, JOINTS, LEFT, WIDTH, dress

PARTS = (
    ("free", "torque of the leg itself [N·m]", tuple(name for name, _ in JOINTS)),
    ("tau", "torque as it was [N·m]", tuple(name for name, _ in JOINTS)),
    ("q", "angle [rad]", tuple(name for name, _ in JOINTS)),
    ("force", "force on the foot [N]", ("forward", "left", "up")),
)
"""Rows of the picture: the field, what it is, and its three lines."""
TALL, BETWEEN, TOP, GAP = 1.7, 0.6, 1.3, 0.6
"""Height of a panel, below it, above the first one, between two [in]."""
PHASE = np.arange(BINS) / BINS


def profile_picture(robot: Robot, profile: Profile, path: Path, before: Profile | None = None) -> Path:
    """Draws a profile as PNG; of an edited one what it was stands behind it, dashed."""
    sheet = Sheet(height=TOP + len(PARTS) * (TALL + BETWEEN))
    forward, left, turn = (part + 0.0 for part in profile.command)
    title = f"{robot.name}: {profile.skill} at {forward:.2f} m/s, {left:.2f} m/s left, {turn:.2f} rad/s"
    left_edge = LEFT / WIDTH
    sheet.figure.text(left_edge, 1 - 0.42 / sheet.height, title, fontsize=17, fontweight="bold", color=INK)
    about = f"the teacher's torque repeats within {profile.repeat:.1%} from one start to another"
    said = f"edited, {profile.edited}; dashed: as it was" if profile.edited else about
    sheet.figure.text(left_edge, 1 - 0.72 / sheet.height, said, fontsize=12, color=INK)
    width = (WIDTH - LEFT - 0.35 - GAP * (robot.n - 1)) / robot.n
    for row, (field, what, names) in enumerate(PARTS):
        for k, leg in enumerate(robot.legs):
            ax = sheet.axes(LEFT + k * (width + GAP), TOP + row * (TALL + BETWEEN), width, TALL)
            draw(ax, robot, profile, before, (field, k))
            ax.set_xlabel("phase" if row == len(PARTS) - 1 else "")
            dress(ax, f"{leg}   {what}" if k == 0 else leg)
            if k == robot.n - 1:
                ax.legend(
                    names, fontsize=9, frameon=False, ncols=3, loc="lower right", bbox_to_anchor=(1.0, 1.0)
                )
    with whole(path) as draft:
        sheet.figure.savefig(draft, format="png")
    return path


def draw(ax: Axes, robot: Robot, profile: Profile, before: Profile | None, which: tuple[str, int]) -> None:
    """Three lines of one leg."""
    field, k = which
    where = ROW.slices(robot.n)
    part = slice(where[field].start + 3 * k, where[field].start + 3 * k + 3)
    for line, (_, colour) in zip(profile.table[:, part].T, JOINTS, strict=True):
        ax.plot(PHASE, line, color=colour, linewidth=1.3)
    if before is not None:
        for line, (_, colour) in zip(before.table[:, part].T, JOINTS, strict=True):
            ax.plot(PHASE, line, color=colour, linewidth=0.9, linestyle=(0, (4, 3)))
    down = profile.table[:, where["stance"].start + k] > 0.5
    ax.fill_between(PHASE, 0.0, 1.0, where=down.tolist(), transform=ax.get_xaxis_transform(), color="#e9ecef",
                    linewidth=0, zorder=0)  # fmt: skip
    ax.set_xlim(0.0, 1.0)
