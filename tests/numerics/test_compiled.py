"""Kernels on disk: several processes may begin at once."""

import os
import subprocess
import sys
from pathlib import Path

ROTATES = """
import numpy as np
from gaitwright.numerics.geometry import rotation
rotation(np.array([1.0, 0.0, 0.0, 0.0]))
print(sum(rotation.stats.cache_misses.values()), sum(rotation.stats.cache_hits.values()))
"""


def test_of_several_processes_one_compiles_and_the_others_load(tmp_path: Path):
    world = {**os.environ, "XDG_CACHE_HOME": str(tmp_path)}
    begun = [
        subprocess.Popen([sys.executable, "-c", ROTATES], env=world, stdout=subprocess.PIPE, text=True)
        for _ in range(4)
    ]
    said = [process.communicate(timeout=300)[0].split() for process in begun]
    assert sorted(said) == [["0", "1"]] * 3 + [["1", "0"]]
