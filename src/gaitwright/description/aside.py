"""What a robot's file says and MuJoCo is not told: rates of joints, loops, tendons, coupled joints."""

import math
import xml.etree.ElementTree as ET
from typing import NamedTuple


class Aside(NamedTuple):
    """What was read beside the model."""

    rates: dict[str, float]
    """Velocity limits by joint, as written [rad/s]."""
    loops: tuple[str, ...]
    """What closes a loop of bodies, in words."""
    coupled: tuple[str, ...]
    """Joints that follow another one."""
    tendons: tuple[str, ...]


def aside_of(root: ET.Element) -> Aside:
    """What an MJCF or URDF tree says aside, before it is made plain."""
    return Aside(
        rates={
            joint.get("name", ""): rate for joint in root.findall("joint") if (rate := rate_of(joint)) > 0.0
        },
        loops=tuple(
            both for kind in ("connect", "weld") for loop in active(root, kind) if (both := ends(loop))
        ),
        coupled=(
            *(joint.get("name", "") for joint in root.findall("joint") if joint.find("mimic") is not None),
            *(pair.get("joint1", "") for pair in active(root, "joint") if pair.get("joint2")),
        ),
        tendons=tuple(tendon.get("name", "") for kind in root.findall("tendon") for tendon in kind),
    )


def rate_of(joint: ET.Element) -> float:
    """The velocity limit of a URDF joint; 0 where there is none."""
    limit = joint.find("limit")
    try:
        rate = float(limit.get("velocity", "0")) if limit is not None else 0.0
    except ValueError:
        return 0.0
    return rate if math.isfinite(rate) else 0.0


def active(root: ET.Element, kind: str) -> list[ET.Element]:
    """The equalities of a kind that are not switched off."""
    return [found for found in root.findall(f"equality/{kind}") if found.get("active") != "false"]


def ends(loop: ET.Element) -> str:
    """The two bodies or sites that an equality holds together; empty for one that is held in the world."""
    both = [loop.get(f"{what}{i}") for i in (1, 2) for what in ("body", "site") if loop.get(f"{what}{i}")]
    return " and ".join(map(repr, both)) if len(both) > 1 else ""


def notes_of(aside: Aside) -> tuple[str, ...]:
    """A sentence for each kind of thing that is left out."""
    kinds = (
        ("the loops that join {} are left open: legs move as if driven at their hinges", aside.loops),
        ("the tendons {} are left out", tuple(map(repr, aside.tendons))),
    )
    return tuple(sentence.format(listed(found)) for sentence, found in kinds if found)


def listed(words: tuple[str, ...] | list[str], most: int = 6) -> str:
    """Words in a row, the first of many."""
    more = f" and {len(words) - most} more" if len(words) > most else ""
    return ", ".join(words[:most]) + more
