"""What must hold of a moving tree of ball-jointed links, each by another way than Armstrong's (row N8).

Energy and momentum, and the closed form: all equations at once, solved by elimination. Arguments as in
`armstrong.accelerations`.
"""

import numpy as np
from jaxtyping import Float

from gaitwright.dynamics.tree import Tree, about_point
from gaitwright.numerics.compiled import kernel
from gaitwright.numerics.geometry import add, cross, dot, scale, vec
from gaitwright.numerics.matrices import apply, mat, put_row, row, skew


# --- energy and momentum -------------------------------------------------------------------------
@kernel
def about_centre(tree, r, w):
    """Jc w, with Jc = J + m ~c ~c the inertia of link `r` about its centre of mass."""
    c = row(tree.com, r)
    return add(apply(mat(tree.inertia, r), w), scale(tree.mass[r], cross(c, cross(c, w))))


@kernel
def hinge_motions(tree, R, x, v, w):
    """Positions and velocities `(links, 3)` of the hinges, world; `x`, `v` are those of the root's origin."""
    n = tree.mass.size
    position, velocity = np.empty((n, 3)), np.empty((n, 3))
    put_row(position, 0, vec(x))
    put_row(velocity, 0, vec(v))
    for r in range(1, n):
        p, l = tree.parent[r], row(tree.hinge, r)
        put_row(position, r, add(row(position, p), apply(mat(R, p), l)))
        put_row(velocity, r, add(row(velocity, p), apply(mat(R, p), cross(row(w, p), l))))
    return position, velocity


@kernel
def energy(tree, R, x, v, w, gravity):
    """Kinetic and potential energy [J]; `x`, `v (3,)`: of the root's origin, world; zero height at z = 0."""
    position, velocity = hinge_motions(tree, R, x, v, w)
    kinetic, potential = 0.0, 0.0
    for r in range(tree.mass.size):
        m, c, w_r = tree.mass[r], row(tree.com, r), row(w, r)
        r_c = add(row(position, r), apply(mat(R, r), c))
        v_c = add(row(velocity, r), apply(mat(R, r), cross(w_r, c)))
        kinetic += 0.5 * (m * dot(v_c, v_c) + dot(w_r, about_centre(tree, r, w_r)))
        potential -= m * dot(r_c, gravity)
    return kinetic, potential


@kernel
def momentum(tree, R, x, v, w):
    """Linear [N·s] and angular momentum about the WORLD's origin [N·m·s], world axes; `x`, `v` as above."""
    position, velocity = hinge_motions(tree, R, x, v, w)
    linear, angular = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for r in range(tree.mass.size):
        c, w_r = row(tree.com, r), row(w, r)
        push = scale(tree.mass[r], add(row(velocity, r), apply(mat(R, r), cross(w_r, c))))
        linear = add(linear, push)
        spin = apply(mat(R, r), about_centre(tree, r, w_r))
        angular = add(angular, add(spin, cross(add(row(position, r), apply(mat(R, r), c)), push)))
    return linear, angular


# --- closed form ---------------------------------------------------------------------------------
def closed_form_accelerations(
    tree: Tree,
    R: Float[np.ndarray, "links 3 3"],
    w: Float[np.ndarray, "links 3"],
    torque: Float[np.ndarray, "links 3"],
    force: Float[np.ndarray, "links 3"],
    moment: Float[np.ndarray, "links 3"],
    gravity: Float[np.ndarray, "3"],
) -> Float[np.ndarray, "rows 3"]:
    """What `armstrong.accelerations` computes, from the mass matrix of all links: H y = b, solved at once.

    The unknowns y are its rows: the acceleration of the root's origin and every wd. A power balance with
    each unknown as the virtual velocity gives one row of H and b.
    """
    n = tree.mass.size
    H, b = np.zeros((3 + 3 * n, 3 + 3 * n)), np.zeros(3 + 3 * n)
    of_hinge, bias = np.zeros((n, 3, 3 + 3 * n)), np.zeros((n, 3))
    of_hinge[0, :, :3] = np.eye(3)
    for r in range(n):
        p, m, c, own = tree.parent[r], tree.mass[r], tree.com[r], slice(3 + 3 * r, 6 + 3 * r)
        if r > 0:
            above = slice(3 + 3 * p, 6 + 3 * p)
            of_hinge[r] = of_hinge[p]
            of_hinge[r][:, above] -= R[p] @ crossing(tree.hinge[r])
            bias[r] = bias[p] + R[p] @ np.cross(w[p], np.cross(w[p], tree.hinge[r]))
            b[above] -= R[p].T @ R[r] @ torque[r]
            b[own] += torque[r]
        of_centre = of_hinge[r].copy()
        of_centre[:, own] -= R[r] @ crossing(c)
        velocity_part = bias[r] + R[r] @ np.cross(w[r], np.cross(w[r], c))
        J_c = tree.inertia[r] - about_point(m, c)
        H += m * of_centre.T @ of_centre
        H[own, own] += J_c
        b += of_centre.T @ (force[r] + m * (gravity - velocity_part))
        b[own] += R[r].T @ moment[r] - np.cross(c, R[r].T @ force[r]) - np.cross(w[r], J_c @ w[r])
    return np.linalg.solve(H, b).reshape(1 + n, 3)


def crossing(a: Float[np.ndarray, "3"]) -> Float[np.ndarray, "3 3"]:
    """~a as an array."""
    return np.array(skew(tuple(a)))
