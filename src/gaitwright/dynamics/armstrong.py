"""Direct dynamics of a tree of ball-jointed links, by Armstrong's recursion (row N6; equations.md §3).

Every link's angular acceleration and the force it exerts on its parent are linear in the acceleration
`a` of its own hinge: wd = K a + d (eq. 4-4) and f = M a + f' (eq. 4-5). In from the leaves to the root
go the coefficients; the root feels no parent, f = 0, which gives its `a`; out go the accelerations.
O(links), and no mass matrix.

K and M depend on orientations only, which change *slowly*; d and f' also on rates and loads, which
change *fast*: `slow_coefficients` may be asked for less often than `fast_accelerations`.

Symbols, for link r, in its own axes: J (about the hinge), c, m, w; for its child s, in the axes of r:
l, R g_s, R f'_s, Ms = R M_s Rᵀ and u_s = w × (w × l). S sums over the children, as each adds its own.
Gravity enters as the force m·gravity; `a` is the true acceleration.
"""

from typing import NamedTuple

import numpy as np

from gaitwright.dynamics.tree import unpacked_tree
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, scale, sub
from gaitwright.numerics.matrices import (
    add_row,
    apply,
    apply_t,
    diagonal,
    inverse,
    mat,
    minus,
    plus,
    product,
    product_t,
    put,
    put_row,
    row,
    skew,
    skewed,
    t_product,
    transpose,
)


class Slow(NamedTuple):
    """What depends on orientations only; each `(links, 3, 3)`, link axes unless said."""

    R: np.ndarray
    """Link components → parent components; row 0 is the identity."""
    K: np.ndarray
    """Angular acceleration per acceleration of the hinge (eq. 4-6) [1/m]."""
    M: np.ndarray
    """Force on the parent per acceleration of the hinge (eq. 4-8) [kg], in the PARENT's axes (root: own)."""
    A_inverse: np.ndarray
    """Inverse of A = J + S ~l Ms ~l, the inertia that a torque at the hinge meets [1/(kg·m²)]."""


# --- slow: orientations --------------------------------------------------------------------------
@kernel
def slow_coefficients(tree, R):
    """The `Slow` part for orientations `R (links, 3, 3)`, link → world (eq. 4-6, 4-8)."""
    n = tree.mass.size
    block = np.empty((4, n, 3, 3))
    slow = Slow(block[0], block[1], block[2], block[3])
    A, B, M = slow.A_inverse, slow.K, slow.M  # until a link's turn comes, these hold its sums
    for r in range(n):
        put(A, r, mat(tree.inertia, r))
        put(B, r, skew(scale(-tree.mass[r], row(tree.com, r))))
        put(M, r, diagonal(-tree.mass[r]))
    put(slow.R, 0, diagonal(1.0))
    for r in range(n - 1, -1, -1):
        A_inverse = inverse(mat(A, r))  # A = J + S ~l Ms ~l
        B_r = mat(B, r)  # B = S ~l Ms - m ~c, and Bᵀ = m ~c - S Ms ~l, since Ms is symmetric
        K = product(A_inverse, B_r)  # (4-6)
        M_r = plus(mat(M, r), t_product(B_r, K))  # (4-8): -m I + S Ms + (m ~c - S Ms ~l) K
        put(slow.A_inverse, r, A_inverse)
        put(slow.K, r, K)
        put(slow.M, r, M_r)
        if r > 0:
            p, l = tree.parent[r], row(tree.hinge, r)
            R_r = t_product(mat(R, p), mat(R, r))
            Ms = product_t(product(R_r, M_r), R_r)
            lMs = skewed(l, Ms)
            put(slow.R, r, R_r)
            put(slow.M, r, Ms)
            put(A, p, minus(mat(A, p), skewed(l, transpose(lMs))))  # + ~l Ms ~l: (~l Ms)ᵀ = -Ms ~l
            put(B, p, plus(mat(B, p), lMs))
            put(M, p, plus(mat(M, p), Ms))
    return slow


# --- fast: rates and loads -----------------------------------------------------------------------
@kernel
def fast_accelerations(tree, slow, R, w, torque, force, moment, gravity):
    """What `accelerations` gives, with `slow` from these or slightly older orientations."""
    n = tree.mass.size
    out, f = np.empty((1 + n, 3)), np.empty((n, 3))
    d = out[1:]
    own_loads(tree, R, w, torque, force, moment, gravity, d, f)
    move_in(tree, slow, w, torque, d, f)
    a_0 = apply(inverse(mat(slow.M, 0)), scale(-1.0, row(f, 0)))  # no parent pulls: 0 = M a + f'
    put_row(out, 0, apply(mat(R, 0), a_0))
    move_out(tree, slow, w, a_0, f, d)
    return out


@kernel
def own_loads(tree, R, w, torque, force, moment, gravity, e, f):
    """Writes the summands of d (eq. 4-7, before A⁻¹) and of f' (eq. 4-9) that are a link's own."""
    for r in range(tree.mass.size):
        m, c, w_r, R_r = tree.mass[r], row(tree.com, r), row(w, r), mat(R, r)
        weight = scale(m, apply_t(R_r, gravity))
        omega = cross(w_r, apply(mat(tree.inertia, r), w_r))
        g = scale(-1.0, row(torque, r)) if r > 0 else (0.0, 0.0, 0.0)
        put_row(e, r, sub(add(apply_t(R_r, row(moment, r)), cross(c, weight)), add(omega, g)))
        put_row(f, r, sub(add(apply_t(R_r, row(force, r)), weight), scale(m, centripetal(w_r, c))))


@kernel
def move_in(tree, slow, w, torque, d, f):
    """Leaves to root: completes the sums, and makes d (eq. 4-7) and f' (eq. 4-9) of them."""
    for r in range(tree.mass.size - 1, -1, -1):
        e = row(d, r)
        f_r = add(row(f, r), apply_t(mat(slow.K, r), e))  # (m ~c - S Ms ~l) d = Bᵀ A⁻¹ e = Kᵀ e
        put_row(d, r, apply(mat(slow.A_inverse, r), e))
        put_row(f, r, f_r)
        if r > 0:
            p, l = tree.parent[r], row(tree.hinge, r)
            u = centripetal(row(w, p), l)
            q = add(apply(mat(slow.R, r), f_r), apply(mat(slow.M, r), u))  # R f'_s + Ms u_s
            add_row(d, p, sub(cross(l, q), apply(mat(slow.R, r), row(torque, r))))
            add_row(f, p, q)


@kernel
def move_out(tree, slow, w, a_0, a, wd):
    """Root to leaves, eq. 4-3 and 4-4: writes the hinges' accelerations `a`, and makes wd of d."""
    put_row(a, 0, a_0)
    put_row(wd, 0, add(apply(mat(slow.K, 0), a_0), row(wd, 0)))
    for r in range(1, tree.mass.size):
        p, l = tree.parent[r], row(tree.hinge, r)
        a_l = add(row(a, p), sub(centripetal(row(w, p), l), cross(l, row(wd, p))))
        a_r = apply_t(mat(slow.R, r), a_l)
        put_row(a, r, a_r)
        put_row(wd, r, add(apply(mat(slow.K, r), a_r), row(wd, r)))


@kernel
def centripetal(w, r):
    """w × (w × r)."""
    return cross(w, cross(w, r))


# --- both ----------------------------------------------------------------------------------------
@kernel
def accelerations(tree, R, w, torque, force, moment, gravity):
    """Accelerations `(1 + links, 3)` of a tree that floats.

    `R (links, 3, 3)`: link → world. `w (links, 3)`: angular velocities, each in the link's own axes.
    `torque (links, 3)`: of the parent on the link at its ball joint, the link's axes; row 0 counts for
    nothing. `force`, `moment` `(links, 3)`: from outside, WORLD axes, the moment about the link's hinge
    (a force f at p from it: p × f). `gravity (3,)`: world.

    Row 0: acceleration of the root's origin, world axes [m/s²]; row 1 + k: angular acceleration of
    link k in its own axes [rad/s²].
    """
    return fast_accelerations(tree, slow_coefficients(tree, R), R, w, torque, force, moment, gravity)


@kernel
def packed_accelerations(numbers, motion, load):
    """`accelerations` for three flat arrays, which a call from Python pays far less for.

    `numbers`: `packed(tree)`. `motion (12 links,)`: all of R, then all of w. `load (9 links + 3,)`:
    all of torque, of force, of moment, then gravity.
    """
    n = motion.size // 12
    R, w = motion[: 9 * n].reshape(n, 3, 3), motion[9 * n :].reshape(n, 3)
    three = load[: 9 * n].reshape(3, n, 3)
    return accelerations(unpacked_tree(numbers), R, w, three[0], three[1], three[2], load[9 * n :])
