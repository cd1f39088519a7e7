"""A tree of rigid links joined by ball-and-socket joints, as plain numbers (row N6; equations.md §3).

A link's origin is its *hinge*, the ball joint that holds it to its parent; the root floats and its
origin may be any of its points. Every joint turns freely about three axes, so a link's orientation is
its own: absolute, not relative to its parent.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from jaxtyping import Float

from gaitwright.errors import WrongUse
from gaitwright.model.robot import Robot
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import about_axis

THINNEST = 1e-6
"""Least principal moment of a link about its hinge, per its largest: Armstrong divides by it."""
SLACK = 1e-9
"""Rounding allowed in what makes an inertia possible, per the largest moment."""


class Tree(NamedTuple):
    """Links in an order where parents come first; link 0 is the root. SI units."""

    parent: np.ndarray
    """`(links,)` int64: the parent's number; -1 for the root."""
    hinge: np.ndarray
    """`(links, 3)` l: the parent's hinge → the link's, PARENT's axes [m]; row 0 is zero."""
    mass: np.ndarray
    """`(links,)` m [kg]."""
    com: np.ndarray
    """`(links, 3)` c: hinge → centre of mass, link axes [m]."""
    inertia: np.ndarray
    """`(links, 3, 3)` J: inertia about the HINGE, link axes [kg·m²]."""


def checked_tree(tree: Tree, names: Sequence[str] = ()) -> Tree:
    """The same tree with arrays as kernels want them; `WrongUse` where no such thing can move.

    `names` are what the sentences call the links; without them they are "link 0", "link 1", ….
    """
    n = len(tree.parent)
    names = names or [f"link {k}" for k in range(n)]
    if n == 0 or len(names) != n:
        raise WrongUse(
            f"a tree of {n} links with {len(names)} names: it needs a root, and a name for every link"
        )
    shapes = Tree((n,), (n, 3), (n,), (n, 3), (n, 3, 3))  # pyright: ignore[reportArgumentType]
    for field, value, shape in zip(Tree._fields, tree, shapes, strict=True):
        if np.shape(value) != shape:
            raise WrongUse(f"{field} of a tree of {n} links has the shape {np.shape(value)}, not {shape}")
    parent, *numbers = tree
    floats = [np.ascontiguousarray(x, dtype=np.float64) for x in numbers]
    checked = Tree(np.ascontiguousarray(parent, dtype=np.int64), *floats)
    for k, name in enumerate(names):
        check_place(checked, k, name)
        check_body(float(checked.mass[k]), checked.com[k], checked.inertia[k], name)
    return checked


def check_place(tree: Tree, k: int, name: str) -> None:
    """`WrongUse` where a link has a number that is none, or no place in the tree."""
    for field, value in zip(Tree._fields, tree, strict=True):
        if not np.isfinite(value[k]).all():
            raise WrongUse(f"{field} of {name} is {value[k].tolist()}: every number must be finite")
    p = int(tree.parent[k])
    if k == 0 and (p != -1 or tree.hinge[0].any()):
        raise WrongUse(
            f"{name} is the root: its parent must be -1, not {p}, "
            f"and its hinge zero, not {tree.hinge[0].tolist()}"
        )
    if k > 0 and not 0 <= p < k:
        raise WrongUse(
            f"{name} is link {k} and has link {p} as its parent: parents come first, so 0 … {k - 1}"
        )


def check_body(m: float, c: Float[np.ndarray, "3"], J: Float[np.ndarray, "3 3"], name: str) -> None:
    """`WrongUse` where mass `m`, centre `c` and inertia `J` about the hinge are those of no body."""
    if not m > 0.0:
        raise WrongUse(f"{name} has a mass of {m:g} kg; a link between ball joints needs one above zero")
    if np.abs(J - J.T).max() > SLACK * np.abs(J).max():
        raise WrongUse(f"the inertia of {name} is not symmetric: {J.tolist()}")
    about_hinge = np.linalg.eigvalsh(J)
    if not about_hinge[0] > THINNEST * about_hinge[2]:
        raise WrongUse(
            f"the inertia of {name} about its hinge is not positive definite: principal moments "
            f"{listed(about_hinge)} kg·m²; a ball joint lets it turn about every axis"
        )
    least, middle, most = about_centre = np.linalg.eigvalsh(J - about_point(m, c))
    slack = SLACK * about_hinge[2]
    if least < -slack or least + middle < most - slack:
        raise WrongUse(
            f"the inertia of {name} is that of no body: principal moments about its centre of mass "
            f"{listed(about_centre)} kg·m², where none may be negative or exceed the sum of the others"
        )


def listed(moments: Float[np.ndarray, "3"]) -> str:
    """Three numbers as a sentence has them."""
    return ", ".join(f"{x:.4g}" for x in moments)


def about_point(mass: float, c: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3 3"]:
    """-m ~c ~c: what the parallel axes theorem adds for a point at -c from the centre of mass [kg·m²]."""
    return mass * (float(c @ c) * np.eye(3) - np.outer(c, c))


# --- one array -----------------------------------------------------------------------------------
def packed(tree: Tree) -> Float[np.ndarray, "numbers"]:
    """All numbers of a tree in one array: one argument costs a kernel call far less than five."""
    return np.concatenate([np.ravel(field).astype(np.float64) for field in tree])


@kernel
def unpacked_tree(numbers):
    """The `Tree` in a `packed` one; all but the parents are views."""
    n = numbers.size // 17
    return Tree(
        numbers[:n].astype(np.int64),
        numbers[n : 4 * n].reshape(n, 3),
        numbers[4 * n : 5 * n],
        numbers[5 * n : 8 * n].reshape(n, 3),
        numbers[8 * n :].reshape(n, 3, 3),
    )


# --- a robot with ball joints --------------------------------------------------------------------
def ball_tree(robot: Robot) -> tuple[Tree, tuple[str, ...]]:
    """The robot with a ball-and-socket joint at every hinge, and the names of its links.

    Base first, then leg by leg "FL hip", "FL thigh", "FL shank"; a massless first link, whose two
    hinges meet in one point, is left out: one ball joint does what its two hinges did. Link axes are
    those of `Robot`: a link's orientation is `R_wb @ leg_frame @ Rx(q1) @ Ry(q2) @ Ry(sign q3)`, with
    as many turns as the link has hinges before it (`ball_rotations`). Rotors are not part of the tree.
    """
    names, parents, hinges = ["base"], [-1], [np.zeros(3)]
    masses, coms, inertias = [robot.base_mass], [robot.base_com], [robot.base_inertia]
    for k, leg in enumerate(robot.legs):
        first = first_link(robot, k)
        for i in range(first, 3):
            names.append(f"{leg} {('hip', 'thigh', 'shank')[i]}")
            parents.append(0 if i == first else len(parents) - 1)
            hinges.append(robot.hip[k] if i == first else robot.offset[k, i - 1])
            masses.append(float(robot.mass[k, i]))
            coms.append(robot.com[k, i])
            inertias.append(robot.inertia[k, i])
    about_hinge = [J + about_point(m, c) for m, c, J in zip(masses, coms, inertias, strict=True)]
    tree = Tree(np.array(parents), np.array(hinges), np.array(masses), np.array(coms), np.array(about_hinge))
    return checked_tree(tree, names), tuple(names)


def first_link(robot: Robot, k: int) -> int:
    """1 where the first link of leg `k` is massless and hinges 1 and 2 meet in a point, else 0."""
    if robot.mass[k, 0] > 0.0:
        return 0
    if robot.offset[k, 0].any():
        raise WrongUse(
            f"the first link of leg {robot.legs[k]} of {robot.name} has no mass and a length of "
            f"{np.linalg.norm(robot.offset[k, 0]):g} m; with ball joints it needs mass or no length"
        )
    return 1


def ball_rotations(
    robot: Robot, R_wb: Float[np.ndarray, "3 3"], q: Float[np.ndarray, "legs 3"]
) -> Float[np.ndarray, "links 3 3"]:
    """Link → world for the links of `ball_tree`, as hinge angles `q` [rad] would turn them."""
    out = [R_wb]
    for k in range(robot.n):
        R = R_wb @ robot.leg_frame[k]
        for i, turn in enumerate(
            (about_axis(0, q[k, 0]), about_axis(1, q[k, 1]), about_axis(1, robot.sign[k] * q[k, 2]))
        ):
            R = R @ turn
            if i >= first_link(robot, k):
                out.append(R)
    return np.array(out)
