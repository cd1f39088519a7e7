"""Joint angles asked for → torques: a position servo at every joint, which knows no mechanics.

A spring and a damper between the angle that is and the angle that is asked for. The drivers that have no
dynamics (rows S1, J4) move real mechanics through it: what weight and speed take, its spring must give
up as an error, so a body on servos hangs a little low and lags a little behind.
"""

from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.signals import MotionTarget, MotorCommand, Posture, Sensed

SERVOED = "solved by joint servo"
"""Status of torques that rest on no force distribution."""
NO_NUMBER = "the joint servo was given what is not a number"


class Gains(NamedTuple):
    """How stiff a servo is, in the robot's own measures."""

    stiffness: float = 2.0
    """K over m g h [1/rad]."""
    damping: float = 0.5
    """D over m g h √(h/g) [1/rad]."""


STIFF = Gains()
"""What walked best. Stiffness alone is not enough: the body on its legs must be damped well, about as much as
it oscillates; twice the stiffness with half the damping for it falls within a second."""


@kernel
def servo(tau_max, stiffness, damping, q_wanted, qd_wanted, q, qd):
    """Torques `(legs, 3)` of springs [N·m/rad] and dampers [N·m·s/rad], within the limits; NaN stays NaN."""
    out = np.empty(q.shape)
    for leg in range(q.shape[0]):
        for j in range(3):
            most = tau_max[leg, j]
            tau = stiffness * (q_wanted[leg, j] - q[leg, j]) + damping * (qd_wanted[leg, j] - qd[leg, j])
            # Not min and max: they would make a number of what is none.
            if tau > most:
                tau = most
            elif tau < -most:
                tau = -most
            out[leg, j] = tau
    return out


def posture_of(target: MotionTarget) -> Posture:
    """The posture that a target asks for."""
    return Posture(target.position_w, target.rotation_wb, target.q, target.stance)


def servo_command(
    robot: Robot,
    gains: Gains,
    q: Float[np.ndarray, "legs 3"],
    qd: Float[np.ndarray, "legs 3"],
    sensed: Sensed,
    posture: Posture,
) -> MotorCommand:
    """What the servos do for joint angles `q` [rad] and rates `qd` [rad/s] asked for.

    No number in, none out: whoever watches stops the motors. `posture` goes along for a plant without
    mechanics.
    """
    weight, height, natural = robot.measures
    stiffness = gains.stiffness * weight * height
    damping = gains.damping * weight * height / natural
    nothing = np.zeros((robot.n, 3))
    if not (sensed.is_finite() and np.isfinite(q).all() and np.isfinite(qd).all()):
        return MotorCommand(np.full((robot.n, 3), np.nan), nothing, 0.0, NO_NUMBER)
    tau = servo(robot.tau_max, stiffness, damping, q, qd, sensed.q, sensed.qd)
    return MotorCommand(tau, nothing, 0.0, SERVOED, posture=posture)
