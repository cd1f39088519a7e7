"""The one file that knows the solvers: DAQP for quadratic and linear programs.

DAQP is a small dual active-set solver in C, well kept, and the fastest on problems of a dozen
unknowns (performance.md); HiGHS and quadprog stand by as oracles in the tests.
"""

import daqp
import numpy as np
from jaxtyping import Float

EXIT_SENTENCES = {
    1: "solved",
    2: "solved, a soft limit in use",
    -1: "these feet cannot carry this load without slipping or overloading a joint",
    -2: "the force distribution did not converge",
    -3: "the force distribution is unbounded",
    -4: "the force distribution took too many steps",
}


def solve_qp(
    hessian: Float[np.ndarray, "n n"] | None,
    gradient: Float[np.ndarray, "n"],
    rows: Float[np.ndarray, "m n"],
    lower: Float[np.ndarray, "k"],
    upper: Float[np.ndarray, "k"],
) -> tuple[Float[np.ndarray, "n"], str]:
    """Minimises ½xᵀHx + gᵀx; the first k − m bounds are on x itself, the others on `rows @ x`.

    No hessian makes it a linear program.
    Without unknowns there is nothing to solve. Returns x and a status sentence, `"solved"` where it is.
    """
    if not gradient.size:
        return gradient, "solved"
    x, _, code, _ = daqp.solve(hessian, gradient, rows, upper, lower, np.zeros(upper.size, dtype=np.int32))
    return x, EXIT_SENTENCES.get(code, f"the solver stopped with code {code}")


def solve_lp(
    cost: Float[np.ndarray, "n"],
    rows: Float[np.ndarray, "m n"],
    lower: Float[np.ndarray, "k"],
    upper: Float[np.ndarray, "k"],
) -> tuple[Float[np.ndarray, "n"], str]:
    """Minimises cᵀx under the same bounds as `solve_qp`."""
    return solve_qp(None, cost, rows, lower, upper)
