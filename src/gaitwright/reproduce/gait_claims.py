"""What the thesis says about the curves of both gaits, held against runs of ours."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from gaitwright.model.robot import Robot
from gaitwright.reproduce.claim import Claim, Grid
from gaitwright.reproduce.gaits import SPEED, cycle_of
from gaitwright.reproduce.patterns import (
    KNEE,
    NOTICED,
    PSI,
    THETA,
    both_signs,
    flexed,
    half_cycle_difference,
    reversals,
    reverses_at_lift_off,
)
from gaitwright.reproduce.thesis_axes import SIDEWAYS, angles_to_thesis, torques_to_thesis
from gaitwright.reproduce.torques import CycleTorques, free_torques
from gaitwright.signals import Gait

FASTER = (0.5, 1.0, 1.5, 2.0, 3.0)
"""Speeds at which a swing is looked at too [m/s], with the same stride."""


@dataclass(frozen=True)
class Run:
    """A robot through a cycle."""

    label: str
    torques: CycleTorques

    @property
    def g(self) -> np.ndarray:
        """Torques in the thesis's sense, `(steps, 4, 3)` [N·m]."""
        return torques_to_thesis(self.torques.tau)

    @property
    def stance(self) -> np.ndarray:
        return self.torques.cycle.stance

    def plain(self) -> dict:
        """The curves as plain JSON values; `null` where there is no solution."""
        curves = self.g.round(6).astype(object)
        curves[~self.torques.solved] = None
        return {
            "label": self.label,
            "solved": float(self.torques.solved.mean()),
            "time_s": self.torques.cycle.time.round(9).tolist(),
            "stance": self.stance.tolist(),
            "psi_theta_knee_Nm": curves.tolist(),
        }


def run_grid(runs: Sequence[Run]) -> Grid:
    """How each run went, in a line."""
    rows = []
    for run in runs:
        g, down = run.g[run.torques.solved], run.stance[run.torques.solved]
        hip, knee, yaw = (g[..., joint][down] for joint in (THETA, KNEE, PSI))
        moments, missing = (a[run.torques.solved] for a in (run.torques.moments_w, run.torques.missing))
        most = (np.linalg.norm(a, axis=-1).max() for a in (moments, missing[:, :3], missing[:, 3:]))
        rows.append(
            (
                run.label,
                f"{100 * run.torques.solved.mean():.0f} %",
                span(hip, 0),
                f"{hip.mean():.0f}",
                span(knee, 0),
                span(yaw, 1),
                *(f"{value:.0f}" for value in most),
            )
        )
    head = ("robot, feet, order", "solved", "τ_θ in stance", "mean", "τ_k", "τ_ψ", "most moment on a foot",
            "most force [N]", "and moment unbalanced")  # fmt: skip
    return Grid("runs: share of samples with a solution, torques of the feet that are down [N·m]", head, rows)


def span(values: np.ndarray, digits: int) -> str:
    """From the smallest to the largest, without a sign for nothing."""
    low, high = (round(float(v), digits) + 0.0 for v in (values.min(), values.max()))
    return f"{low:.{digits}f} … {high:.{digits}f}"


# --- the posture -----------------------------------------------------------------------------------
def posture(run: Run) -> list[Claim]:
    """Around which angles the joints move."""
    angles = np.degrees(angles_to_thesis(run.torques.cycle.q))
    azimuth = (angles[..., 0] - np.degrees(SIDEWAYS) + 180.0) % 360.0 - 180.0
    knee, elevation = 90.0 + angles[..., 2], angles[..., 1]
    table = "Table 6.1 itself has {}, as ours has with the leg straight sideways"

    def around(values: np.ndarray) -> str:
        return f"around {round(float(values.mean()), 1) + 0.0:.1f}° ({span(values, 0)})"

    return [
        Claim("knee angle", "fluctuates around 90°", around(knee), None, table.format("70.8°")),
        Claim(
            "hip azimuth",
            "fluctuates around 0°",
            around(azimuth),
            bool(abs(azimuth.mean()) < 2.0),
            "counted from straight sideways; mean within 2°",
        ),
        Claim("hip elevation", "fluctuates around 10°", around(elevation), None, table.format("21.9°")),
    ]


# --- the swing -------------------------------------------------------------------------------------
def lift_off(runs: Sequence[Run]) -> Claim:
    """τ_θ at lift-off."""
    good = [
        all(reverses_at_lift_off(run.g[:, leg, THETA], run.stance[:, leg]) for leg in range(4))
        for run in runs
    ]
    return Claim(
        "τ_θ where a foot leaves the ground",
        "goes from flexion to extension",
        "so in every leg of " + join(runs, good),
        all(good),
    )


def knee_in_swing(runs: Sequence[Run]) -> Claim:
    """τ_k during the swing."""
    share = [1.0 - flexed(run.g[..., KNEE], ~run.stance) for run in runs]
    return Claim(
        "τ_k during the swing",
        "extends the knee",
        f"extends it in {100 * min(share):.0f} % of the samples",
        min(share) > 0.99,
        "the motor holds the lower limb outward against its weight; the same for all robots",
    )


def azimuth_in_swing(run: Run, order: str) -> Claim:
    """τ_ψ during the swing."""
    turns = [reversals(run.g[:, leg, PSI], ~run.stance[:, leg]) for leg in range(4)]
    most = np.abs(run.g[..., PSI][~run.stance]).max()
    return Claim(
        "τ_ψ during the swing",
        f"changes {order} to drive the hip forward",
        f"changes its sign once in {turns.count(1)} of 4 legs, up to {most:.2f} N·m",
        turns == [1, 1, 1, 1],
        "drives the leg forward, then brakes it; which of the two is called flexion the thesis does not say",
    )


def hip_in_swing(robot: Robot, gait_at: Callable[[float], Gait], said: str) -> Claim:
    """τ_θ during the swing, at the thesis's speed and at higher ones."""
    ranges = {}
    for speed in (SPEED, *FASTER):
        cycle = cycle_of(robot, gait_at(speed))
        torque = torques_to_thesis(free_torques(robot, cycle))[..., THETA][~cycle.stance]
        ranges[speed] = (float(torque.min()), float(torque.max()))
    first = next((speed for speed, (_, high) in ranges.items() if high > NOTICED), None)
    low, high = ranges[SPEED]
    shown = FASTER[-1] if first is None else first
    fast = f"{ranges[shown][0]:.0f} … {ranges[shown][1]:+.0f} N·m at {shown:g} m/s"
    return Claim(
        "τ_θ during the swing",
        said,
        f"{low:.1f} … {high:.1f} N·m: extension throughout; " + fast,
        None,
        "at 1/6 m/s a swinging leg asks for little but its own weight; "
        + (
            f"of the speeds looked at, both signs appear from {first:g} m/s up"
            if first
            else "no sign changes"
        ),
        {f"{speed:.4g}_mps": list(pair) for speed, pair in ranges.items()},
    )


# --- the stance ------------------------------------------------------------------------------------
def hip_in_stance(runs: Sequence[Run], said: str, least: float) -> Claim:
    """τ_θ in stance."""
    share = {run.label: flexed(run.g[..., THETA], run.stance) for run in runs}
    return Claim(
        "τ_θ during the stance",
        said,
        "; ".join(f"{label}: {100 * s:.0f} % of the samples" for label, s in share.items()),
        min(share.values()) >= least,
        f"at least {100 * least:.0f} %",
        share,
    )


def alternation(joint: int, runs: Sequence[Run], judge: str | None, because: str) -> Claim:
    """Whether τ_k or τ_ψ has both signs in every leg's stance; judged by the run labelled `judge`, if any."""
    name = {KNEE: "τ_k", PSI: "τ_ψ"}[joint]
    found = {run.label: both_signs(run.g[..., joint], run.stance) for run in runs}
    return Claim(
        f"{name} during the stance",
        "alternates between flexion and extension",
        "; ".join(f"{label}: {'yes' if is_so else 'no'}" for label, is_so in found.items()),
        None if judge is None else found[judge],
        because,
        found,
    )


def join(runs: Sequence[Run], good: Sequence[bool]) -> str:
    """The runs of which something is true."""
    return "; ".join(run.label for run, is_so in zip(runs, good, strict=True) if is_so) or "none"


def symmetry(runs: list[Run], what: str, thesis: str, found: str) -> Claim:
    """Left and right half a cycle later; `found`: what is the same, as a formula."""
    worst = max(half_cycle_difference(run.g) for run in runs)
    return Claim(
        what,
        thesis,
        f"{found} within {worst:.0e} N·m",
        worst < 0.01,
        "mirrored; within 0.01 N·m",
        {"largest_difference_Nm": worst},
    )
