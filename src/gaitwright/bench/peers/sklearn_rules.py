"""CART and k-nearest neighbours of scikit-learn on the same demonstrations.

Runs in scikit-learn's own environment and imports nothing of gaitwright. One argument: a JSON file with
`schools`, each with `shown` and `asked` (rows of 0 and 1), `skills` (what is right in the shown ones) and
`right` (in the asked ones). Writes one JSON object: the version, and for each learner its share of right
answers in each school.
"""

import json
import sys
from pathlib import Path

import numpy as np
import sklearn  # pyright: ignore[reportMissingImports]
from sklearn.neighbors import KNeighborsClassifier  # pyright: ignore[reportMissingImports]
from sklearn.tree import DecisionTreeClassifier  # pyright: ignore[reportMissingImports]

NEIGHBOURS = (1, 3, 5)


def main(path: Path) -> None:
    """Learns and answers school by school."""
    schools = json.loads(path.read_text(encoding="utf-8"))["schools"]
    learners = {"CART": lambda: DecisionTreeClassifier(random_state=0)}
    learners |= {f"{k}-NN": lambda k=k: KNeighborsClassifier(k) for k in NEIGHBOURS}
    shares = {name: [share(make(), school) for school in schools] for name, make in learners.items()}
    print(json.dumps({"version": sklearn.__version__, "shares": shares}), flush=True)


def share(learner, school: dict) -> float:
    """The share of the asked situations that it answers rightly."""
    learner.fit(np.array(school["shown"]), np.array(school["skills"]))
    return float(np.mean(learner.predict(np.array(school["asked"])) == np.array(school["right"])))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
