"""What is left of a mission on its way: where to plan to once more is known of the ground."""

from dataclasses import replace

from gaitwright.signals import Mission, Route


def rest_of(mission: Mission, route: Route) -> Mission:
    """The mission with the way-points alone that its route still leads over, and its goal."""
    left, path = [], list(route.path)
    for point in reversed(mission.waypoints):
        if point not in path:
            break
        left.append(point)
        path = path[: len(path) - 1 - path[::-1].index(point)]
    return replace(mission, waypoints=tuple(left[::-1]) or mission.waypoints[-1:])
