import os
import pathlib
import subprocess

import pytest

project = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def rod():
    """A rod of 40 mm with a fixed force on its tip, a tendon, gravity and a moment in its middle."""
    return {
        "title": "rod",
        "rod": {"sections": [
            {"length_mm": 30, "stiffness": {"bending_Nmm2": 1500, "torsion_Nmm2": 1000, "mass_per_length_kg_per_m": 0.03}},
            {"length_mm": 10, "stiffness": {"bending_Nmm2": [700, 900], "torsion_Nmm2": 500}}]},
        "loads": [{"kind": "force", "at": "tip", "frame": "fixed", "value_N": [0.1, 0.2, 0.3]},
                  {"kind": "tendon", "offset_mm": [1, 0], "tension_N": 1},
                  {"kind": "gravity", "acceleration_m_per_s2": [0, 0, -9.81]},
                  {"kind": "moment", "at": 25, "frame": "follower", "value_Nmm": [1, 2, 5]},
                  {"kind": "distributed_force", "frame": "follower", "value_N_per_mm": [0, 0.001, 0]}],
    }


@pytest.fixture
def circle():
    """A cantilever with a moment about z at its tip, an arc of a circle: angle M L / EI = 1 rad, radius 100 mm."""
    return {"rod": {"sections": [{"length_mm": 100, "stiffness": {"bending_Nmm2": 1500, "torsion_Nmm2": 1000}}]},
            "loads": [{"kind": "moment", "at": "tip", "frame": "follower", "value_Nmm": [0, 0, 15]}]}


@pytest.fixture
def command():
    """Runs the command fam: exit status, standard output, standard error."""
    def run(*arguments, **options):
        done = subprocess.run([os.environ["FAM_COMMAND"], *map(str, arguments)], capture_output=True, text=True, **options)
        return done.returncode, done.stdout, done.stderr
    return run
