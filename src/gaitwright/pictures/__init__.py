"""A trip as one picture: the way over the ground, speed, attitude and torques. Needs the extra `plot`."""

from pathlib import Path

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from gaitwright.files import whole
from gaitwright.ground.scene import Scene
from gaitwright.pictures.charts import draw_attitude, draw_speed, draw_torques
from gaitwright.pictures.map import draw_map
from gaitwright.pictures.style import DPI, INK, LEFT, MAP, WIDTH
from gaitwright.record.recording import Recording


def trip_picture(recording: Recording, scene: Scene, path: str | Path) -> Path:
    """Draws a trip as PNG: map, speed, attitude, and the torques of every leg."""
    r = recording.sound()
    across = 3 if r.robot.n % 4 else 4
    rows = r.robot.n // across
    sheet = Sheet(height=10.3 + 2.55 * rows)
    sheet.head(headline(r), summary(r))
    draw_map(sheet.axes(LEFT, 0.95, *MAP), r, scene)
    draw_speed(sheet.axes(LEFT, 7.35, 7.1, 1.9), r)
    draw_attitude(sheet.axes(LEFT + MAP[0] - 7.1, 7.35, 7.1, 1.9), r)
    width = (MAP[0] - 0.55 * (across - 1)) / across
    for leg in range(r.robot.n):
        row, column = divmod(leg, across)
        place = sheet.axes(LEFT + (width + 0.55) * column, 10.15 + 2.55 * row, width, 1.75)
        draw_torques(place, r, leg)
    with whole(Path(path)) as draft:
        sheet.figure.savefig(draft, format="png")
    return Path(path)


class Sheet:
    """A figure on which axes are placed in inches from its top left."""

    def __init__(self, height: float) -> None:
        self.height = height
        self.figure = Figure(figsize=(WIDTH, height), dpi=DPI)
        FigureCanvasAgg(self.figure)

    def head(self, title: str, line: str) -> None:
        """Writes a title, and a line below it."""
        for below, text, size, weight in ((0.42, title, 19, "bold"), (0.75, line, 12, "normal")):
            at = 1 - below / self.height
            self.figure.text(LEFT / WIDTH, at, text, fontsize=size, fontweight=weight, color=INK)

    def axes(self, left: float, top: float, width: float, height: float) -> Axes:
        bottom = self.height - top - height
        inches = (left / WIDTH, bottom / self.height, width / WIDTH, height / self.height)
        return self.figure.add_axes(inches)


def headline(r: Recording) -> str:
    return f"{r.robot.name} in {r.scene or 'a scene'}: {r.stopped_because}"


def summary(r: Recording) -> str:
    """The figures in a line."""
    report = r.figures(state_hash="")
    falls = "no fall" if not report.falls else "fell"
    return (
        f"{report.distance_m:.1f} m in {report.duration_s:.1f} s   ·   {falls}   ·   velocity error "
        f"{report.velocity_error_mps:.3f} m/s   ·   cost of transport {report.cost_of_transport:.2f}   ·   "
        f"desirability {report.desirability:.2f}"
    )
