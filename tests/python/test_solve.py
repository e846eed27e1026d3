"""fam.solve: the numbers of closed forms and of the command; failures, wrong input."""

import json
import math
import os
import threading

import numpy as np
import pytest

import fam
from conftest import project

ARRAYS = {"s_mm": (), "position_mm": (3,), "rotation": (3, 3), "force_N": (3,), "moment_Nmm": (3,)}
ENDS = {"tip_position_mm": (3,), "tip_rotation": (3, 3), "base_force_N": (3,), "base_moment_Nmm": (3,)}


def tip_of_circle_mm(angle_rad, length_mm=100):
    return np.array([math.sin(angle_rad), 1 - math.cos(angle_rad), 0]) * length_mm / angle_rad


def test_arc_of_a_circle(circle):
    e = fam.solve(circle)
    assert (e.status, e.converged, e.message, e.stable) == ("converged", True, "", None)
    assert np.abs(e.tip_position_mm - tip_of_circle_mm(1)).max() < 1e-12  # round-off
    c, s = math.cos(1), math.sin(1)
    assert np.abs(e.tip_rotation - [[c, -s, 0], [s, c, 0], [0, 0, 1]]).max() < 1e-14
    assert e.tip_angle_rad == pytest.approx(1, abs=1e-14)
    assert np.abs(e.base_moment_Nmm - [0, 0, 15]).max() < 1e-12
    assert np.abs(e.base_force_N).max() < 1e-14
    assert np.abs(e.position_mm[1:] - [tip_of_circle_mm(s / 100, s) for s in e.s_mm[1:]]).max() < 1e-12
    circle["rod"]["sections"][0]["stiffness"]["bending_Nmm2"] *= 1.05
    assert np.abs(fam.solve(circle).tip_position_mm - tip_of_circle_mm(1)).max() > 1


def test_every_number_is_that_of_the_command(rod, command, tmp_path):
    path = tmp_path / "rod.json"
    path.write_text(json.dumps(rod))
    for options in [], ["--tolerance-mm", "1e-6"], ["--arcs", "12", "--law", "fourth_order", "--model", "kirchhoff"]:
        status, out, _ = command("solve", path, "--format", "json", *options)
        assert status == 0
        printed = json.loads(out)
        keywords = {option[2:].replace("-", "_"): value for option, value in zip(options[::2], options[1::2])}
        e = fam.solve(path, **{k: v if k in ("law", "model") else json.loads(v) for k, v in keywords.items()})
        assert np.array_equal(e.tip_position_mm, printed["tip"]["position_mm"])
        assert np.array_equal(e.tip_rotation, printed["tip"]["rotation"])
        assert e.tip_angle_rad == printed["tip"]["angle_rad"]
        assert np.array_equal(e.base_force_N, printed["base"]["force_N"])
        assert np.array_equal(e.base_moment_Nmm, printed["base"]["moment_Nmm"])
        for name in ARRAYS:
            assert np.array_equal(getattr(e, name), [station[name] for station in printed["centreline"]])
        assert e.error_estimate_mm == printed["error_estimate_mm"]
        assert e.stable == printed["stable"]
        assert e.model == printed["model"]
        assert np.array_equal(e.tendon_shortening_mm, [t["shortening_mm"] for t in printed["tendons"]])


def test_scene_as_dict_text_and_path(rod, tmp_path):
    path = tmp_path / "rod.json"
    path.write_text(json.dumps(rod))
    other = tmp_path / os.fsdecode(b"r\xf6d.json")  # a name need not be Unicode
    other.write_text(json.dumps(rod))
    numpys = json.loads(json.dumps(rod))
    numpys["loads"][0]["value_N"] = np.array([0.1, 0.2, 0.3])
    numpys["loads"][3]["at"] = np.int64(25)
    numpys["loads"][3]["value_Nmm"] = np.array([1, 2, 5], dtype=np.int32)
    numpys["rod"]["sections"][0]["length_mm"] = np.float32(30)
    numpys["rod"]["sections"] = tuple(numpys["rod"]["sections"])
    tips = [fam.solve(scene).tip_position_mm
            for scene in (rod, numpys, json.dumps(rod), "\n " + json.dumps(rod, indent=1), "\ufeff" + json.dumps(rod),
                          path, str(path), other, os.fsdecode(other))]
    assert all(np.array_equal(tip, tips[0]) for tip in tips)
    rod["title"] = 'R\u00f6hre "1"\\\n\t\u2028 \U0001f600'
    assert fam.solve(rod).converged


@pytest.mark.parametrize("scene, says", [
    ("a\0b.json", "is neither JSON text nor the name of a file"),
    ('{"title": "\udce9"}', "is not Unicode"),
])
def test_text_that_is_no_scene(scene, says):
    with pytest.raises(fam.SceneError, match=says):
        fam.solve(scene)


def test_shapes_types_and_read_only_views(rod):
    e = fam.solve(rod)
    n = len(e.s_mm)
    assert n >= 41
    for name, shape in ARRAYS.items():
        array = getattr(e, name)
        assert array.shape == (n, *shape) and array.dtype == np.float64
        assert array.base is e  # not a copy
        with pytest.raises(ValueError):
            array[0] = 1
    for name, shape in ENDS.items():
        assert getattr(e, name).shape == shape
    assert np.abs(np.einsum("nij,nik->njk", e.rotation, e.rotation) - np.eye(3)).max() < 1e-12
    assert np.array_equal(e.rotation[-1], e.tip_rotation) and np.array_equal(e.position_mm[-1], e.tip_position_mm)
    kept = e.position_mm
    before = kept.copy()
    del e  # the view keeps what it looks at
    fam.solve(rod)
    assert np.array_equal(kept, before)


def test_stable(circle):
    assert fam.solve({**circle, "loads": []}).stable is True
    column = {"kind": "force", "at": "tip", "frame": "fixed", "value_N": [-0.5, 0, 0]}  # Euler: pi^2 EI / 4 L^2 = 0.37 N
    assert fam.solve({**circle, "loads": [column]}).stable is False
    assert fam.solve(circle).stable is None


def test_a_failed_solve_does_not_raise(rod):
    e = fam.solve(rod, law="published")
    assert (e.status, e.converged, e.stable) == ("unsupported", False, None)
    assert e.message == "loads[0]: the published law cannot solve a force in a fixed frame"
    for name, shape in ARRAYS.items():
        assert getattr(e, name).shape == (0, *shape)
    for name, shape in ENDS.items():
        assert getattr(e, name).shape == shape and np.isnan(getattr(e, name)).all()
    assert math.isnan(e.error_estimate_mm) and math.isnan(e.tip_angle_rad)
    assert "unsupported" in repr(e)


def at(scene, *path):
    for step in path:
        scene = scene[step]
    return scene


WRONG = [(("rod", "sections", 0, "length_mm"), -4), (("rod", "sections", 0, "length"), 4), (("loads", 0, "at"), 41),
         (("loads", 0, "value_N"), [1, 2]), (("loads", 0, "value_N"), "up"), (("loads", 1, "tension_N"), -3),
         (("loads", 3, "kind"), "torque"), (("loads", 0, "frame"), None), (("rod",), []), (("loads", 2), True),
         (("rod", "sections", 1, "stiffness", "bending_Nmm2"), [700, 0.0]), (("titel",), 'a "quoted"\n name \u00f6')]


@pytest.mark.parametrize("path, value", WRONG)
def test_wrong_scenes_are_the_line_of_the_command(rod, command, tmp_path, path, value):
    at(rod, *path[:-1])[path[-1]] = value
    file = tmp_path / "wrong.json"
    file.write_text(json.dumps(rod))
    status, _, line = command("solve", file)
    assert status == 2 and line.count("\n") == 1
    for scene, source in (rod, "scene"), (json.dumps(rod), "scene"), (str(file), str(file)), (file, str(file)):
        for take in fam.solve, fam.Solver, lambda s: fam.solve_batch(s, [], np.zeros((1, 0))):
            with pytest.raises(fam.SceneError) as error:
                take(scene)
            assert str(error.value) + "\n" == line.replace(str(file), source)
    assert issubclass(fam.SceneError, ValueError)


def test_wrong_in_python_alone(rod):
    looped = {}
    looped["rod"] = looped
    for scene, message in [
            (7, "scene: (top level) = 7: must be a dict, JSON text or a path"),
            (None, "scene: (top level) = None: must be a dict, JSON text or a path"),
            ("nowhere.json", "nowhere.json: (file) = (unreadable): must be a readable scene file"),
            ({"rod": {1: 2}}, "scene: rod = 1: a key must be text"),
            ({"rod": {"sections": {2}}}, "scene: rod.sections = {2}: must be a dict, a list, a number or text"),
            ({"rod": float("nan")}, "scene: rod = nan: must be finite"),
            ({"loads": [0, np.array([0, math.inf])]}, "scene: loads[1][1] = inf: must be finite"),
            ({"rod": 1j}, "scene: rod = 1j: must be a dict, a list, a number or text"),
            ({"title": "\ud800"}, "scene: title = '\\ud800': is not Unicode")]:
        with pytest.raises(fam.SceneError) as error:
            fam.solve(scene)
        assert str(error.value) == message
    with pytest.raises(fam.SceneError, match="nested too deeply"):
        fam.solve(looped)
    with pytest.raises(fam.SceneError, match="1e999|finite|not fit"):
        fam.solve({"rod": 10**400})


@pytest.mark.parametrize("keywords, message", [
    ({"tolerance_mm": 0}, "tolerance_mm = 0: must be a number > 0"),
    ({"tolerance_mm": math.nan}, "tolerance_mm = nan: must be a number > 0"),
    ({"tolerance_mm": "1"}, "tolerance_mm = '1': must be a number > 0"),
    ({"arcs": 0}, "arcs = 0: must be a whole number, 1 to 1000000"),
    ({"arcs": 10**30}, f"arcs = {10**30}: must be a whole number, 1 to 1000000"),
    ({"arcs": 2.5}, "arcs = 2.5: must be a whole number, 1 to 1000000"),
    ({"arcs": 4, "tolerance_mm": 1}, "arcs = 4: excludes tolerance_mm"),
    ({"law": "euler"}, "law = 'euler': must be auto, published, midpoint, fourth_order or sixth_order"),
    ({"model": None}, "model = None: must be auto, kirchhoff or reissner")])
def test_wrong_options(rod, keywords, message):
    for take in fam.solve, fam.Solver:
        with pytest.raises(fam.SceneError) as error:
            take(rod, **keywords)
        assert str(error.value) == message


def test_all_cases_of_study_1_solve():
    cases = sorted((project / "studies/cases/study1").glob("*.json"))
    assert len(cases) == 32
    assert all(fam.solve(case, tolerance_mm=1e-3).error_estimate_mm <= 1e-3 for case in cases)


def test_threads_solve_at_once(rod):
    expected = fam.solve(rod, tolerance_mm=1e-8).tip_position_mm
    tips = [None] * 4

    def work(k):
        for _ in range(5):
            tips[k] = fam.solve(rod, tolerance_mm=1e-8).tip_position_mm

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    [thread.start() for thread in threads]
    [thread.join() for thread in threads]
    assert all(np.array_equal(tip, expected) for tip in tips)
