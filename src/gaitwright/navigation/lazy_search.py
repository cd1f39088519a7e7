"""The shortest path over roads by A*: what is not tested yet is tested when it would be gone.

Hart, Nilsson and Raphael 1968, with links tested at the last moment (Cohen, Phillips and Likhachev 2015
call it lazy weighted A*; here the weight is 1). An entry of the queue is a link, not a node; the first link
to reach a state that stands its test is the best one.
"""

import math

import numpy as np

from gaitwright.navigation.piece_grid import is_free, leaves
from gaitwright.navigation.raster import is_known
from gaitwright.navigation.roads import find_links, way_round
from gaitwright.navigation.tolerances import LINK
from gaitwright.numerics.compiled import kernel

FULL = -2.0
"""Instead of a length: there was no room for links."""
NONE = -1.0
"""Instead of a length: there is no way."""


@kernel
def search(roads, sources, ignored, goal, most, place, cells):
    """Length of the shortest path [m] and its points from a source to the goal, `NONE` or `FULL`.

    `sources`: rows x, y, cost of coming there [m]; the first is the robot's own place, where links keep what
    room there is (`leaves`, which ignores what is nearer than `ignored`). Paths longer than `most` [m] are
    not looked for. Where `cells` is not empty, all must lie in known ground.
    """
    states = len(roads.found)
    goal_state = states + len(sources)
    best, parent = np.full(goal_state + 1, np.inf), np.full(goal_state + 1, -1)
    closed = np.zeros(goal_state + 1, np.bool_)
    heap, links, count = np.empty(1024), np.empty((1024, 2), np.int64), 0
    for k in range(len(sources)):
        far = math.hypot(goal[0] - sources[k, 0], goal[1] - sources[k, 1])
        heap, links, count = push(heap, links, count, sources[k, 2] + far, states + k, states + k)
        best[states + k] = sources[k, 2]
    while count:
        f, u, v = heap[0], links[0, 0], links[0, 1]
        count = pop(heap, links, count)
        if f > most:
            break
        if closed[v]:
            continue
        if u != v:
            ax, ay = point_of(roads, sources, goal, u)
            bx, by = point_of(roads, sources, goal, v)
            if not stands(roads, (u, v, states), (ax, ay, bx, by), ignored, place, cells):
                continue
            parent[v], best[v] = u, best[u] + math.hypot(bx - ax, by - ay)
        closed[v] = True
        if v == goal_state:
            return best[v], trace(roads, sources, goal, parent)
        if v < states:
            if roads.found[v, 0] < 0 and not find_links(roads, v):
                return FULL, np.empty((0, 2))
            believes = cells.size == 0  # a link that was found stands
            heap, links, count = go_on(roads, goal, v, best, believes, heap, links, count, goal_state)
        else:
            heap, links, count = set_out(roads, sources, goal, v, best, heap, links, count)
    return NONE, np.empty((0, 2))


@kernel
def stands(roads, states, line, ignored, place, cells):
    """Whether a link may be gone: those between nodes were tested when they were found."""
    u, v, nodes = states
    ax, ay, bx, by = line
    if cells.size and not is_known(cells, place, ax, ay, bx, by):
        return False
    room = roads.radius - LINK
    if u == nodes:
        return leaves(roads.grid, ax, ay, bx, by, room, ignored)
    return (u < nodes and v < nodes) or is_free(roads.grid, ax, ay, bx, by, room)


@kernel
def go_on(roads, goal, u, best, believes, heap, links, count, goal_state):
    """Queues the links of a state that may lead somewhere sooner, and the straight line to the goal."""
    at, node = roads.nodes.at, roads.nodes.at[u // 2]
    dx, dy = goal[0] - node[0], goal[1] - node[1]
    if way_round(node, dx, dy, roads.nodes.lean[u // 2]) == u % 2:
        heap, links, count = push(heap, links, count, best[u] + math.hypot(dx, dy), u, goal_state)
    begin = roads.found[u, 0]
    for n in range(begin, begin + roads.found[u, 1]):
        v = roads.targets[n]
        x, y = at[v // 2, 0], at[v // 2, 1]
        cost = best[u] + math.hypot(x - node[0], y - node[1])
        if cost < best[v]:
            if believes:
                best[v] = cost
            f = cost + math.hypot(goal[0] - x, goal[1] - y)
            heap, links, count = push(heap, links, count, f, u, v)
    return heap, links, count


@kernel
def set_out(roads, sources, goal, u, best, heap, links, count):
    """Queues the straight lines from a source to all nodes, and to the goal."""
    at, lean, states = roads.nodes.at, roads.nodes.lean, len(roads.found)
    x, y = sources[u - states, 0], sources[u - states, 1]
    f = best[u] + math.hypot(goal[0] - x, goal[1] - y)
    heap, links, count = push(heap, links, count, f, u, states + len(sources))
    for k in range(len(at)):
        dx, dy = at[k, 0] - x, at[k, 1] - y
        on = way_round(at[k], dx, dy, lean[k])
        cost = best[u] + math.hypot(dx, dy)
        if on >= 0 and cost < best[2 * k + on]:
            f = cost + math.hypot(goal[0] - at[k, 0], goal[1] - at[k, 1])
            heap, links, count = push(heap, links, count, f, u, 2 * k + on)
    return heap, links, count


@kernel
def point_of(roads, sources, goal, state):
    """The place of a state [m]."""
    states = len(roads.found)
    if state < states:
        return roads.nodes.at[state // 2, 0], roads.nodes.at[state // 2, 1]
    if state < states + len(sources):
        return sources[state - states, 0], sources[state - states, 1]
    return goal[0], goal[1]


@kernel
def trace(roads, sources, goal, parent):
    """Points of a path from its source (included) to the goal."""
    state, count = len(parent) - 1, 0
    while state >= 0:
        state, count = parent[state], count + 1
    points, state = np.empty((count, 2)), len(parent) - 1
    for n in range(count - 1, -1, -1):
        points[n, 0], points[n, 1] = point_of(roads, sources, goal, state)
        state = parent[state]
    return points


# --- a queue: the entry with the least number is the first ------------------------------------------
@kernel
def push(heap, links, count, f, u, v):
    """The queue with one more entry."""
    if count == len(heap):
        heap = np.concatenate((heap, np.empty_like(heap)))
        links = np.concatenate((links, np.empty_like(links)))
    n = count
    while n > 0 and heap[(n - 1) // 2] > f:
        above = (n - 1) // 2
        heap[n], links[n, 0], links[n, 1] = heap[above], links[above, 0], links[above, 1]
        n = above
    heap[n], links[n, 0], links[n, 1] = f, u, v
    return heap, links, count + 1


@kernel
def pop(heap, links, count):
    """Takes the first entry out; returns how many are left."""
    count -= 1
    f, u, v = heap[count], links[count, 0], links[count, 1]
    n = 0
    while 2 * n + 1 < count:
        below = 2 * n + 1
        if below + 1 < count and heap[below + 1] < heap[below]:
            below += 1
        if heap[below] >= f:
            break
        heap[n], links[n, 0], links[n, 1] = heap[below], links[below, 0], links[below, 1]
        n = below
    heap[n], links[n, 0], links[n, 1] = f, u, v
    return count
