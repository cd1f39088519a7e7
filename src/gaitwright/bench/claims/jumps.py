"""How foot forces jump from tick to tick, by each way to share loads, as figures and a picture."""

from collections.abc import Iterator, Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path

import numpy as np
from jaxtyping import Float

from gaitwright.bench.evidence.moments import Moment
from gaitwright.bench.measurement import Figure
from gaitwright.bench.trial import DT
from gaitwright.control.numerical import NumericalController

PICTURE = Path("runs/bench/force-jumps.png")
SHOWN = 1.0
"""Of the motion so much is drawn [s]."""
FOOT = 0


def force_jumps(
    moments: Sequence[Moment], controllers: Mapping[str, NumericalController]
) -> Iterator[Figure]:
    """Median and largest jump of each controller on the same motion, and a picture of them."""
    down = np.array([moment.target.stance for moment in moments])
    stays = down[1:] & down[:-1]
    forces = {name: followed(controller, moments) for name, controller in controllers.items()}
    jumps = {name: np.linalg.norm(np.diff(f, axis=0), axis=2)[stays] for name, f in forces.items()}
    about = picture(moments, forces, jumps)
    for name, jump in jumps.items():
        for what, value in (("median", np.median(jump)), ("largest", jump.max())):
            yield Figure(f"{name}: force jump, {what}", float(value), "N/tick", None, len(moments), about)


def followed(controller: NumericalController, moments: Sequence[Moment]) -> Float[np.ndarray, "ticks legs 3"]:
    """Foot forces over the motion [N], every tick from the last one's."""
    memory, out = moments[0].memory, []
    for moment in moments:
        command, memory = controller.command(moment.target, moment.sensed, memory)
        out.append(command.forces_w)
    return np.array(out)


def picture(
    moments: Sequence[Moment], forces: Mapping[str, np.ndarray], jumps: Mapping[str, np.ndarray]
) -> str:
    """Draws it, where the extra for that is there; says where it is, or what it needs."""
    if not find_spec("matplotlib"):
        return "the picture is left out: it needs `pip install 'gaitwright[plot]'`"
    from gaitwright.pictures.jumps import jumps_picture  # noqa: PLC0415 - an extra, and slow to import

    ticks = round(SHOWN / DT)
    normals = np.array([moment.target.normal_w for moment in moments[:ticks]])
    lines = {name: np.einsum("ti,ti->t", f[:ticks, FOOT], normals) for name, f in forces.items()}
    return f"picture: {jumps_picture(lines, jumps, DT, PICTURE)}"
