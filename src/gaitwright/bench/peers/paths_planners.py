"""Shortest paths among polygons by other libraries: how long building and asking take.

Runs in an environment of its own and imports nothing of gaitwright. One argument: a JSON file with `side`
[m], `radius` [m], `polygons` and `pairs` of places. Spoken over stdin and stdout, one JSON object a line: a
greeting; for a library's name its version and the times [ms] of building once and of each way.
"""

import importlib.metadata
import json
import math
import sys
import time
from pathlib import Path

import numpy as np
import shapely


def main(path: Path) -> None:
    """Answers until the end of stdin."""
    problem = json.loads(path.read_text(encoding="utf-8"))
    say({"version": shapely.__version__})
    for line in sys.stdin:
        name = line.strip()
        if name == "shapely and networkx":
            say(by_networkx(problem))
        elif name == "extremitypathfinder":
            say(by_extremity(problem))


def grown(problem):
    """The polygons, grown by the radius and joined."""
    polygons = shapely.buffer(shapely.make_valid(
        np.array([shapely.Polygon(ring) for ring in problem["polygons"]])), problem["radius"],
        join_style="mitre", mitre_limit=1.5)  # fmt: skip
    return shapely.union_all(polygons)


def by_networkx(problem) -> dict:
    """A visibility graph by shapely's bulk predicates, ways by networkx's A*."""
    import networkx  # noqa: PLC0415  # pyright: ignore[reportMissingImports]

    def build():
        solid = shapely.buffer(grown(problem), -1e-9)
        corners = shapely.get_coordinates(grown(problem))
        tree = shapely.STRtree(shapely.get_parts(solid))
        graph = networkx.Graph()
        for k, here in enumerate(corners):
            join(graph, tree, corners, k, here, range(k + 1, len(corners)))
        return graph, tree, corners

    def join(graph, tree, corners, name, here, others):
        others = np.array(list(others), dtype=int)
        if not len(others):
            return
        lines = shapely.linestrings(
            np.stack([np.broadcast_to(here, (len(others), 2)), corners[others]], axis=1)
        )
        hidden = np.unique(tree.query(lines, predicate="intersects")[0])
        for k in np.delete(others, hidden):
            graph.add_edge(name, int(k), weight=math.dist(here, corners[k]))

    def way(made, a, b):
        graph, tree, corners = made
        ends = np.vstack([corners, a, b])
        n = len(corners)
        join(graph, tree, ends, n, a, [*range(n), n + 1])
        join(graph, tree, ends, n + 1, b, range(n))
        try:
            return networkx.astar_path(graph, n, n + 1, lambda p, q: math.dist(ends[p], ends[q]))
        except (networkx.NetworkXNoPath, networkx.NodeNotFound):
            return None
        finally:
            graph.remove_nodes_from([n, n + 1])

    return timed(problem, build, way, f"networkx {importlib.metadata.version('networkx')}")


def by_extremity(problem) -> dict:
    """extremitypathfinder: its graph is made when outlines are stored."""
    from extremitypathfinder import PolygonEnvironment  # noqa: PLC0415  # pyright: ignore[reportMissingImports]

    side = problem["side"]

    def build():
        inside = shapely.intersection(grown(problem), shapely.box(0.01, 0.01, side - 0.01, side - 0.01))
        parts = [p for p in shapely.get_parts(inside) if p.geom_type == "Polygon"]
        holes = [np.array(shapely.normalize(p).exterior.coords[:-1]) for p in parts]
        environment = PolygonEnvironment()
        field = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
        environment.store(np.array(field), holes, validate=False)
        return environment

    def way(environment, a, b):
        return environment.find_shortest_path(tuple(a), tuple(b), verify=False)

    return timed(problem, build, way, f"{importlib.metadata.version('extremitypathfinder')}")


def timed(problem, build, way, version) -> dict:
    """Times of building and of the ways between free places [ms]."""
    began = time.perf_counter()
    made = build()
    built = 1e3 * (time.perf_counter() - began)
    solid, times = grown(problem), []
    for a, b in problem["pairs"]:
        if shapely.distance(solid, shapely.points([a, b])).min() > 0.0:
            began = time.perf_counter()
            way(made, a, b)
            times.append(1e3 * (time.perf_counter() - began))
    return {"version": version, "built from nothing": [built], "a way": times}


def say(message: dict) -> None:
    print(json.dumps(message), flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
