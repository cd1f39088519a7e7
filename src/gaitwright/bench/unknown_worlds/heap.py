"""A binary heap of numbered nodes with two keys each, which knows where each node stands; compiled.

`heap` (nodes in heap order), `place` (of each node in it, or −1), `first`, `second` (keys by node). The
number of nodes in it is handed in and back.
"""

from gaitwright.numerics.compiled import kernel


@kernel
def is_less(first, second, a, b):
    """Whether node a comes before node b."""
    return first[a] < first[b] or (first[a] == first[b] and second[a] < second[b])


@kernel
def put(heap, place, at, node):
    heap[at] = node
    place[node] = at


@kernel
def rise(heap, place, first, second, at):
    """Moves the node at a place up to where it belongs."""
    node = heap[at]
    while at > 0:
        above = (at - 1) // 2
        if not is_less(first, second, node, heap[above]):
            break
        put(heap, place, at, heap[above])
        at = above
    put(heap, place, at, node)


@kernel
def sink(heap, place, first, second, count, at):
    """Moves the node at a place down to where it belongs."""
    node = heap[at]
    while True:
        below = 2 * at + 1
        if below >= count:
            break
        if below + 1 < count and is_less(first, second, heap[below + 1], heap[below]):
            below += 1
        if not is_less(first, second, heap[below], node):
            break
        put(heap, place, at, heap[below])
        at = below
    put(heap, place, at, node)


@kernel
def push(heap, place, first, second, count, node):
    """Puts a node in, or moves it after its keys changed; the number of nodes then."""
    if place[node] < 0:
        put(heap, place, count, node)
        count += 1
    rise(heap, place, first, second, place[node])
    sink(heap, place, first, second, count, place[node])
    return count


@kernel
def drop(heap, place, first, second, count, node):
    """Takes a node out; the number of nodes then."""
    at = place[node]
    count -= 1
    last = heap[count]
    place[node] = -1
    if at < count:
        put(heap, place, at, last)
        rise(heap, place, first, second, at)
        sink(heap, place, first, second, count, place[last])
    return count
