"""The examples run, and reach what they say."""

import os
import re
import subprocess
import sys

import numpy as np

from conftest import project


def run(name, *arguments):
    done = subprocess.run([sys.executable, project / "python/examples" / name, *map(str, arguments)],
                          capture_output=True, text=True, env={**os.environ, "DISPLAY": ""})
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_draw_rod(tmp_path):
    import matplotlib.image

    printed = run("draw_rod.py", tmp_path / "rod.png")
    assert len(printed.splitlines()) == 5
    picture = matplotlib.image.imread(tmp_path / "rod.png")
    assert min(picture.shape[:2]) > 500
    assert np.ptp(picture[..., :3]) > 0.9 and picture[..., :3].mean() > 0.8  # lines on white


def test_reach_target():
    lines = run("reach_target.py").splitlines()
    assert len(lines) == 3
    solves = [int(re.search(r"after (\d+) solves", line).group(1)) for line in lines]
    assert max(solves) <= 15  # Newton's: a handful beyond the damped steps
