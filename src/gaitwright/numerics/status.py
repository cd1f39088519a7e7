"""How a distribution of forces can end: codes of both solvers, and what they mean."""

SOLVED, INFEASIBLE, UNBOUNDED, TOO_MANY_STEPS, NOT_FINITE = 0, 1, 2, 3, 4
SENTENCES = {
    SOLVED: "solved",
    INFEASIBLE: "these feet cannot carry this load",
    UNBOUNDED: "the force distribution has no least price",
    TOO_MANY_STEPS: "the force distribution took too many steps",
    NOT_FINITE: "the force distribution was given a number that is not finite",
}
