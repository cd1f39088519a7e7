"""How a distribution of forces can end: codes of both solvers, and what they mean."""

SOLVED, INFEASIBLE, UNBOUNDED, TOO_MANY_STEPS, NOT_FINITE = 0, 1, 2, 3, 4
SENTENCES = {
    SOLVED: "solved",
    INFEASIBLE: "these feet cannot carry this load",
    UNBOUNDED: "no way to share the load over the feet is the best",
    TOO_MANY_STEPS: "how to share the load over the feet was not found in time",
    NOT_FINITE: "the load to be shared over the feet is not a number",
}
