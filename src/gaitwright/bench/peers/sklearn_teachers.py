"""A tree, a forest and boosted trees of scikit-learn on the labels of a test teacher.

Runs in scikit-learn's own environment and imports nothing of gaitwright. One argument: a JSON file with
`shown` (view → a row of numbers for each labelled moment), `said` (the labels) and `exams`, each with
`labels` (how many of the moments were labelled by then), `asked` (as `shown`) and `right`. Each learner is
tuned by cross-validation on the labels. Writes one JSON object: the version, and by exam the share of right
answers of each learner in each view.
"""

import json
import sys
import warnings
from pathlib import Path

import numpy as np
import sklearn  # pyright: ignore[reportMissingImports]
from sklearn.ensemble import (  # pyright: ignore[reportMissingImports]
    HistGradientBoostingClassifier,
    RandomForestClassifier,
)
from sklearn.model_selection import KFold  # pyright: ignore[reportMissingImports]
from sklearn.tree import DecisionTreeClassifier  # pyright: ignore[reportMissingImports]

TREES, TREES_TO_TUNE = 200, 60
"""Trees of a forest, and of one that is only tried."""
FOLDS = {"CART": 5, "forest": 3, "boosting": 3}
GRIDS = {
    "CART": [{"min_samples_leaf": m, "ccp_alpha": a} for m in (1, 2, 4) for a in (0.0, 0.004, 0.012)],
    "forest": [{"max_features": share} for share in ("sqrt", 0.5)],
    "boosting": [
        {"max_leaf_nodes": 8, "min_samples_leaf": 2, "max_iter": 40, "learning_rate": 0.15},
        {"max_leaf_nodes": 15, "min_samples_leaf": 5, "max_iter": 30, "learning_rate": 0.2},
    ],
}
"""Settings tried: leaves of few cases, because there are few; more of them cost more than they gave."""


def main(path: Path) -> None:
    """Learns from the labels of each exam's time and answers."""
    warnings.filterwarnings("ignore")  # classes of one case, of which there are many at first
    problem = json.loads(path.read_text(encoding="utf-8"))
    shown = {view: np.array(rows) for view, rows in problem["shown"].items()}
    said, shares = np.array(problem["said"]), {}
    for exam in problem["exams"]:
        n, right = exam["labels"], np.array(exam["right"])
        shares[str(n)] = {
            f"{name} on {view}": share(name, x[:n], said[:n], np.array(exam["asked"][view]), right)
            for name in GRIDS
            for view, x in shown.items()
        }
    print(json.dumps({"version": sklearn.__version__, "shares": shares}), flush=True)


def share(name: str, x, said, asked, right) -> float:
    """The share of right answers after tuning."""
    if len(set(said)) < 2:
        return float(np.mean(right == said[0]))
    best = max(GRIDS[name], key=lambda settings: validated(name, settings, x, said))
    learner = made(name, best, TREES).fit(x, said)
    return float(np.mean(learner.predict(asked) == right))


def validated(name: str, settings: dict, x, said) -> float:
    """Cases answered rightly by those who learned from the others."""
    found = 0
    for learned, tried in KFold(FOLDS[name], shuffle=True, random_state=0).split(x):
        if len(set(said[learned])) < 2:
            found += int(np.sum(said[tried] == said[learned][0]))
            continue
        learner = made(name, settings, TREES_TO_TUNE).fit(x[learned], said[learned])
        found += int(np.sum(learner.predict(x[tried]) == said[tried]))
    return found


def made(name: str, settings: dict, trees: int):
    """A learner that has learned nothing yet."""
    if name == "CART":
        return DecisionTreeClassifier(random_state=0, **settings)
    if name == "forest":
        return RandomForestClassifier(trees, random_state=0, n_jobs=1, **settings)
    # Without some shrinkage of the leaves, boosting of pure leaves runs away.
    return HistGradientBoostingClassifier(
        early_stopping=False, max_bins=64, l2_regularization=1.0, random_state=0, **settings
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
