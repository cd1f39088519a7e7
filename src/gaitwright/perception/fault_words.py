"""What is found broken, by what a person calls it."""

from dataclasses import dataclass

from gaitwright.model.robot import Robot


@dataclass(frozen=True, slots=True)
class Fault:
    """What is noticed to be broken, and what the robot does about it."""

    kind: str
    leg: str | None
    """Name of the leg; `None` where it is not that of one."""
    joint: str | None
    """hip1, hip2 or knee; `None` where it is not that of one."""
    since: float
    """When it began to show [s]."""
    noticed: float
    """When it was certain [s]."""
    sentence: str
    answer: str
    """`GOES_ON` or `LIES_DOWN`."""


GOES_ON, LIES_DOWN = "goes on", "lies down"
"""What a robot does about a fault."""
KINDS = (
    "",
    "motor-dead",
    "leg-dead",
    "motor-stuck",
    "encoder-frozen",
    "encoder-offset",
    "foot-off",
    "foot-on",
    "imu-frozen",
    "imu-tilted",
    "frozen",
    "late",
)
"""In the order in which the watch numbers them; the names are those by which they can be injected."""
FOOT_FAULTS = ("foot-off", "foot-on")
"""What a robot can walk on with."""
SENTENCES = {
    "motor-dead": "the {joint}'s motor gives no torque since {since:.2f} s",
    "leg-dead": "the motors of the {leg} leg give no torque since {since:.2f} s",
    "motor-stuck": "the {joint} does not turn any more since {since:.2f} s",
    "encoder-frozen": "the {joint}'s angle sensor keeps its reading since {since:.2f} s",
    "encoder-offset": "the {joint}'s angle sensor jumped by itself at {since:.2f} s",
    "foot-off": "the {leg} foot's sensor feels nothing since {since:.2f} s, and its leg carries load",
    "foot-on": "the {leg} foot's sensor keeps its reading since {since:.2f} s, and its leg does not",
    "imu-frozen": "attitude and rates of the body keep their reading since {since:.2f} s",
    "imu-tilted": "the attitude of the body jumped by itself at {since:.2f} s",
    "frozen": "all readings stay as they are since {since:.2f} s",
    "late": "readings come {late:.0f} ms late since {since:.2f} s, too late to walk by",
}
JOINTS = ("hip1", "hip2", "knee")
JOINT_WORDS = ("first hip joint", "second hip joint", "knee")
LEG_WORDS = {
    "FL": "front left",
    "FR": "front right",
    "ML": "middle left",
    "MR": "middle right",
    "RL": "rear left",
    "RR": "rear right",
    "LF": "front left",
    "RF": "front right",
    "LM": "middle left",
    "RM": "middle right",
    "LH": "rear left",
    "RH": "rear right",
    "HL": "rear left",
    "HR": "rear right",
}
"""Legs by the names that files of robots have for them."""


def ends_trip(faults: tuple[Fault, ...]) -> bool:
    """Whether something is broken that nobody can walk with; nothing is looked for after it."""
    return bool(faults) and faults[-1].answer == LIES_DOWN


def fault_of(robot: Robot, kind: int, leg: int, joint: int, since: float, noticed: float, dt: float) -> Fault:
    """What the watch found, with its sentence; where it found readings late, `joint` is by how many ticks."""
    name = KINDS[kind]
    own = robot.legs[leg] if leg >= 0 else None
    words = "" if own is None else LEG_WORDS.get(own.upper(), own)
    of_joint = joint >= 0 and own is not None
    sentence = SENTENCES[name].format(
        joint=f"{words} {JOINT_WORDS[joint]}" if of_joint else "",
        leg=words,
        since=since,
        late=1e3 * dt * max(joint, 0),
    )
    answer = GOES_ON if name in FOOT_FAULTS else LIES_DOWN
    return Fault(name, own, JOINTS[joint] if of_joint else None, since, noticed, sentence, answer)
