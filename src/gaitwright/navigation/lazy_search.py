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
OPEN = 0.0
"""Instead of a length: it is not known yet."""
FIRST_CHECK = 512
"""So many states on, and at each doubling, it is asked whether the goal is shut in."""
PORTION, HAIR = 1.1, 1e-3
"""A source queues links that promise up to so many times what it promised before, and so much more [m]."""


@kernel
def length(x, y):
    """Of a vector: quicker than `math.hypot`."""
    return math.sqrt(x * x + y * y)


@kernel
def search(roads, sources, ignored, goal, turning, most, place, cells):
    """Length of the shortest path [m] and its points from a source to the goal, `NONE` or `FULL`.

    `sources`: rows x, y, cost of coming there [m]; the first is the robot's own place, where links keep what
    room there is (`leaves`, which ignores what is nearer than `ignored`). `turning`: where the robot faces
    [rad], and what a radian of turning into the path counts for [m]. Paths longer than `most` [m] are not
    looked for. Where `cells` is not empty, all must lie in known ground.
    """
    states = len(roads.found)
    goal_state = states + len(sources)
    best, parent = np.full(goal_state + 1, np.inf), np.full(goal_state + 1, -1)
    closed, gone_on, check = np.zeros(goal_state + 1, np.bool_), 0, FIRST_CHECK
    heap, links, count = np.empty(1024), np.empty((1024, 2), np.int64), 0
    for k in range(len(sources)):
        far = length(goal[0] - sources[k, 0], goal[1] - sources[k, 1])
        heap, links, count = push(heap, links, count, sources[k, 2] + far, states + k, states + k)
        best[states + k] = sources[k, 2]
    while count:
        f, u, v = heap[0], links[0, 0], links[0, 1]
        count = pop(heap, links, count)
        if f > most:
            break
        if u == v:
            source = (v, f, closed[v])
            heap, links, count = set_out(roads, sources, goal, source, turning, best, heap, links, count)
            closed[v] = True
            continue
        if closed[v]:
            continue
        ax, ay = point_of(roads, sources, goal, u)
        bx, by = point_of(roads, sources, goal, v)
        if not stands(roads, (u, v, states), (ax, ay, bx, by), ignored, place, cells):
            continue
        parent[v], best[v], closed[v] = u, best[u] + length(bx - ax, by - ay), True
        if u >= states:
            best[v] += turned(turning, bx - ax, by - ay)
        if v == goal_state:
            return best[v], trace(roads, sources, goal, parent)
        if roads.found[v, 0] < 0 and not find_links(roads, v):
            return FULL, np.empty((0, 2))
        believes = cells.size == 0  # a link that was found stands
        heap, links, count = go_on(roads, goal, v, best, believes, heap, links, count, goal_state)
        gone_on += 1
        if gone_on == check and most == np.inf:
            check *= 2
            answer = shut_in(roads, sources, ignored, goal, closed, gone_on // 8)
            if answer != OPEN:
                return answer, np.empty((0, 2))
    return NONE, np.empty((0, 2))


@kernel
def shut_in(roads, sources, ignored, goal, closed, most):
    """`NONE` if whatever leads to the goal is no more than `most` states and none is reached from a source;
    `OPEN` if it is more or reached; `FULL` without room for links. A way to the goal is one back from it.
    """
    states, room = len(roads.found), roads.radius - LINK
    reached, todo, count = np.zeros(states, np.bool_), np.empty(states, np.int64), 0
    for k in range(len(roads.nodes.at)):
        x, y = roads.nodes.at[k, 0], roads.nodes.at[k, 1]
        on = way_round(roads.nodes.at[k], x - goal[0], y - goal[1], roads.nodes.lean[k])
        if on >= 0 and is_free(roads.grid, goal[0], goal[1], x, y, room):
            todo[count], reached[2 * k + on], count = 2 * k + on, True, count + 1
    done = 0
    while done < count:
        state, done = todo[done], done + 1
        if closed[state ^ 1] or done > most:
            return OPEN
        if roads.found[state, 0] < 0 and not find_links(roads, state):
            return FULL
        begin = roads.found[state, 0]
        for on in roads.targets[begin : begin + roads.found[state, 1]]:
            if not reached[on]:
                todo[count], reached[on], count = on, True, count + 1
    for state in todo[:count]:
        if is_met(roads, sources, ignored, state ^ 1):
            return OPEN
    return NONE


@kernel
def is_met(roads, sources, ignored, state):
    """Whether a straight line from a source leads to a state."""
    node, lean, room = roads.nodes.at[state // 2], roads.nodes.lean[state // 2], roads.radius - LINK
    for k in range(len(sources)):
        x, y = sources[k, 0], sources[k, 1]
        if way_round(node, node[0] - x, node[1] - y, lean) == state % 2:
            if k == 0 and leaves(roads.grid, x, y, node[0], node[1], room, ignored):
                return True
            if k > 0 and is_free(roads.grid, x, y, node[0], node[1], room):
                return True
    return False


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
        heap, links, count = push(heap, links, count, best[u] + length(dx, dy), u, goal_state)
    begin = roads.found[u, 0]
    for n in range(begin, begin + roads.found[u, 1]):
        v = roads.targets[n]
        x, y = at[v // 2, 0], at[v // 2, 1]
        cost = best[u] + length(x - node[0], y - node[1])
        if cost < best[v]:
            if believes:
                best[v] = cost
            f = cost + length(goal[0] - x, goal[1] - y)
            heap, links, count = push(heap, links, count, f, u, v)
    return heap, links, count


@kernel
def turned(turning, x, y):
    """What it counts for [m] to turn into a direction."""
    facing, price = turning
    if price == 0.0:
        return 0.0
    return price * abs((math.atan2(y, x) - facing + math.pi) % (2.0 * math.pi) - math.pi)


@kernel
def set_out(roads, sources, goal, source, turning, best, heap, links, count):
    """Queues the straight lines from a source to the goal and to all nodes, those that promise most first:
    the source is queued again for the others. `source`: its state, what it promised, whether it was here."""
    at, lean, states = roads.nodes.at, roads.nodes.lean, len(roads.found)
    u, low, again = source
    high = PORTION * low + HAIR
    x, y = sources[u - states, 0], sources[u - states, 1]
    if not again:
        straight = low + turned(turning, goal[0] - x, goal[1] - y)
        heap, links, count = push(heap, links, count, straight, u, states + len(sources))
        low = -1.0
    more = False
    for k in range(len(at)):
        dx, dy = at[k, 0] - x, at[k, 1] - y
        on = way_round(at[k], dx, dy, lean[k])
        if on < 0:
            continue
        cost = best[u] + length(dx, dy) + turned(turning, dx, dy)
        if cost < best[2 * k + on]:
            f = cost + length(goal[0] - at[k, 0], goal[1] - at[k, 1])
            if low < f <= high:
                heap, links, count = push(heap, links, count, f, u, 2 * k + on)
            more = more or f > high
    if more:
        heap, links, count = push(heap, links, count, high, u, u)
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
