"""fam.Solver: the same answers as fam.solve, what is refused and what raises, slopes against differences."""

import math
import threading

import numpy as np
import pytest

import fam

LENGTH_MM = 40
FORCE, TENDON, GRAVITY, MOMENT, DISTRIBUTED = range(5)


def solved(scene, **keywords):
    solver = fam.Solver(scene, **keywords)
    outcome = solver.solve()
    assert outcome.converged, outcome
    return solver


def test_is_what_solve_gives(rod):
    """Every set_... against the scene with that value; both within 1e-6 mm."""
    solver = fam.Solver(rod, tolerance_mm=1e-6)
    solver.set_force_N(FORCE, [0.3, -0.2, 0.1])
    solver.set_tension_N(TENDON, 2.5)
    solver.set_acceleration_m_per_s2(GRAVITY, (0, 9.81, 0))
    solver.set_moment_Nmm(MOMENT, np.array([3.0, 2, 1]))
    solver.set_distributed_N_per_mm(DISTRIBUTED, np.array([[0, 0.01], [0, 0.02], [0, 0.03]])[:, 1])
    solver.set_at_mm(MOMENT, 17)
    solver.set_rest_curvature_per_mm(1, [0.01, 0.02, 0.03])
    outcome = solver.solve(start="unloaded")
    assert (outcome.status, outcome.converged, outcome.message) == ("converged", True, "")
    assert outcome.load_steps >= 0 and outcome.newton_steps >= 0

    rod["loads"][FORCE]["value_N"] = [0.3, -0.2, 0.1]
    rod["loads"][TENDON]["tension_N"] = 2.5
    rod["loads"][GRAVITY]["acceleration_m_per_s2"] = [0, 9.81, 0]
    rod["loads"][MOMENT].update(value_Nmm=[3, 2, 1], at=17)
    rod["loads"][DISTRIBUTED]["value_N_per_mm"] = [0.01, 0.02, 0.03]
    rod["rod"]["sections"][1]["rest_curvature_per_mm"] = [0.01, 0.02, 0.03]
    e = fam.solve(rod, tolerance_mm=1e-6)
    assert np.abs(solver.tip_position_mm - e.tip_position_mm).max() < 2e-6
    assert np.abs(solver.tip_rotation - e.tip_rotation).max() < 1e-5
    assert np.abs(solver.base_force_N - e.base_force_N).max() < 1e-5
    assert np.abs(solver.base_moment_Nmm - e.base_moment_Nmm).max() < 1e-4
    assert solver.error_estimate_mm() <= 1e-6
    assert solver.stable == e.stable
    rod["loads"][FORCE]["value_N"][0] *= 1.05
    assert np.abs(solver.tip_position_mm - fam.solve(rod, tolerance_mm=1e-6).tip_position_mm).max() > 1e-4


def test_arrays(rod):
    solver = solved(rod)
    n = len(solver.s_mm)
    shapes = {"s_mm": (n,), "position_mm": (n, 3), "rotation": (n, 3, 3), "force_N": (n, 3), "moment_Nmm": (n, 3),
              "tip_position_mm": (3,), "tip_rotation": (3, 3), "base_force_N": (3,), "base_moment_Nmm": (3,)}
    for name, shape in shapes.items():
        assert getattr(solver, name).shape == shape
    assert solver.s_mm[0] == 0 and solver.s_mm[-1] == LENGTH_MM and (np.diff(solver.s_mm) > 0).all()
    assert np.array_equal(solver.position_mm[-1], solver.tip_position_mm)
    assert np.array_equal(solver.rotation[-1], solver.tip_rotation)
    assert np.array_equal(solver.force_N[0], solver.base_force_N)
    assert np.array_equal(solver.moment_Nmm[0], solver.base_moment_Nmm)
    assert np.abs(np.einsum("nij,nik->njk", solver.rotation, solver.rotation) - np.eye(3)).max() < 1e-12
    before, copy = solver.position_mm, solver.position_mm.copy()
    solver.set_force_N(FORCE, [0, -1, 0])
    assert np.array_equal(solver.position_mm, copy)  # the solution found last
    assert solver.solve().converged
    assert np.array_equal(before, copy) and np.abs(solver.position_mm[-1] - copy[-1]).max() > 1


def test_anywhere_along_an_arc_of_a_circle(circle):
    solver = solved(circle)
    for s in np.linspace(0, 100, 7):
        position, rotation = solver.pose_at(s)
        c, sine = math.cos(s / 100), math.sin(s / 100)
        assert np.abs(position - [100 * sine, 100 * (1 - c), 0]).max() < 1e-11
        assert np.abs(rotation - [[c, -sine, 0], [sine, c, 0], [0, 0, 1]]).max() < 1e-13
        force, moment = solver.wrench_at(s)
        assert np.abs(force).max() < 1e-12 and np.abs(moment - [0, 0, 15]).max() < 1e-11
    solver.pose_at(100 * (1 + 1e-13))  # round-off of a sum of lengths is on the rod


REFUSED = [
    ("set_force_N", (FORCE, [1, 2]), "scene: loads[0].value_N = [1, 2]: must be an array of 3 numbers"),
    ("set_force_N", (FORCE, "123"), "scene: loads[0].value_N = '123': must be an array of 3 numbers"),
    ("set_force_N", (FORCE, 7), "scene: loads[0].value_N = 7: must be an array of 3 numbers"),
    ("set_force_N", (FORCE, [1, 2, None]), "scene: loads[0].value_N = [1, 2, None]: must be an array of 3 numbers"),
    ("set_force_N", (FORCE, np.zeros((2, 3))), "scene: loads[0].value_N = array([[0., 0., 0.], [0., 0., 0.]]): must be "
                                               "an array of 3 numbers"),
    ("set_force_N", (FORCE, [1, math.nan, 0]), "scene: loads[0].value_N = [1, nan, 0]: must be finite"),
    ("set_tension_N", (TENDON, "3"), "scene: loads[1].tension_N = '3': must be a number"),
    ("set_tension_N", (TENDON, -3), "scene: loads[1].tension_N = -3: must be >= 0"),
    ("set_at_mm", (MOMENT, 41), "scene: loads[3].at = 41: must lie on the rod, 0 < s <= 40 mm"),
    ("set_at_mm", (MOMENT, math.nan), None), ("set_at_mm", (TENDON, 20), None),
    ("set_force_N", (9, [0, 0, 0]), "scene: loads[9]: there are 5 loads"),
    ("set_force_N", (-1, [0, 0, 0]), "scene: loads[-1]: there are 5 loads"), ("set_force_N", (TENDON, [0, 0, 0]), None),
    ("set_moment_Nmm", (FORCE, [0, 0, 0]), None), ("set_tension_N", (FORCE, 1), None),
    ("set_rest_curvature_per_mm", (2, [0, 0, 0]), "scene: rod.sections[2]: there are 2 sections"),
    ("set_rest_curvature_per_mm", (-1, [0, 0, 0]), "scene: rod.sections[-1]: there are 2 sections"),
    ("set_rest_curvature_per_mm", (0, [0, math.inf, 0]), None)]


@pytest.mark.parametrize("name, arguments, message", REFUSED)
def test_a_refused_value_leaves_the_solver_as_it_was(rod, name, arguments, message):
    solver = solved(rod)
    tip = solver.tip_position_mm
    with pytest.raises(fam.SceneError) as error:
        getattr(solver, name)(*arguments)
    assert "\n" not in str(error.value)
    assert message is None or str(error.value) == message
    assert solver.solve("unloaded").converged
    assert np.array_equal(solver.tip_position_mm, tip)


def test_before_a_solution_getters_raise(rod):
    solver = fam.Solver(rod)
    assert solver.solved is False
    for name in dir(solver):
        if name.startswith(("_", "set_")) or name in ("solve", "solved"):
            continue
        arguments = [(), (0,), (0, 0), ([0], [])]
        with pytest.raises(RuntimeError, match="nothing is solved yet"):
            value = getattr(solver, name)
            for given in arguments:
                try:
                    value(*given)
                except TypeError:
                    continue  # another number of arguments


def test_off_the_rod_and_out_of_range(rod):
    solver = solved(rod)
    for s in -1, 40.001, math.nan, math.inf:
        for call in (solver.pose_at, solver.wrench_at, solver.compliance, lambda s: solver.by_load(0, s),
                     lambda s: solver.jacobian([0, s], [("load", 0, "x")])):
            with pytest.raises(ValueError, match="must lie on the rod, 0 <= s <= 40 mm"):
                call(s)
    for index in -1, 5, 10**9:
        for call in solver.by_load, solver.by_place, solver.strain_by_load, solver.wrench_by_place:
            with pytest.raises(IndexError, match="the scene has 5, counted from 0"):
                call(index, 1)
    with pytest.raises(IndexError, match="the scene has 2"):
        solver.by_stiffness(2, 1)
    with pytest.raises(ValueError, match=r"loads\[1\] is a tendon"):
        solver.by_place(TENDON, 1)
    with pytest.raises(fam.SceneError, match="start = 'cold': must be 'last' or 'unloaded'"):
        solver.solve("cold")
    for wrong in -1, 3001, 2.5, "few", None:
        with pytest.raises(fam.SceneError, match="newton_steps_at_most = .*: must be a whole number, 0 to 3000"):
            solver.solve("last", newton_steps_at_most=wrong)
    for wrong in [("load", 0, "w"), ("load", TENDON, "x"), ("load", FORCE, "tension"), ("load", 0), ("place", 0, "x"),
                  ("stiffness", 0, "x"), ("rest_curvature", 0, 1), "load", ("place", TENDON), ("load", 0.5, "x")]:
        with pytest.raises(ValueError):
            solver.jacobian([1], [wrong])
    with pytest.raises(IndexError):
        solver.jacobian([1], [("load", 5, "x")])
    with pytest.raises(ValueError):
        solver.jacobian([[1]], [("load", 0, "x")])


def test_ends_after_as_many_newton_steps_as_it_may_take():
    """A bent column turns half around its axis: a long way."""
    column = fam.Solver({"rod": {"sections": [{"length_mm": LENGTH_MM, "stiffness": {"bending_Nmm2": 1500,
                                                                                      "torsion_Nmm2": 1000}}]},
                         "loads": [{"kind": "force", "at": "tip", "frame": "fixed", "value_N": [-2.3, 0.017, 0.041]}]})
    assert column.solve().converged
    column.set_force_N(0, [-2.9, -0.094, -0.229])
    assert column.solve(newton_steps_at_most=40).status == "work_limit"
    outcome = column.solve()
    assert outcome.converged and outcome.newton_steps > 100


def test_what_the_law_cannot_solve(rod):
    with pytest.raises(RuntimeError, match="unsupported: .*the published law cannot solve a force in a fixed frame"):
        fam.Solver(rod, law="published")


def test_one_solver_in_two_threads_raises(rod):
    """Nobody reads a solver that another thread is solving with."""
    solver = solved(rod, arcs=200)
    seen, stop = [], threading.Event()

    def read():
        while not stop.is_set():
            try:
                seen.append(solver.tip_position_mm)
            except RuntimeError as error:
                assert "another thread" in str(error)

    reader = threading.Thread(target=read)
    reader.start()
    for _ in range(200):
        try:
            solver.solve("unloaded")
        except RuntimeError as error:
            assert "another thread" in str(error)
    stop.set()
    reader.join()
    assert all(np.array_equal(tip, seen[0]) for tip in seen)


def twist(solver, before, s_mm):
    """Change of the pose at s since `before`: (6,), mm and rad."""
    position, rotation = solver.pose_at(s_mm)
    turn = rotation @ before[1].T
    return np.r_[position - before[0], [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]
                 / np.float64(2)]


def difference(scene, change, step, s_mm):
    """Central difference of fourth order of the pose by what change(scene, by) changes."""
    base = solved(scene, tolerance_mm=1e-9).pose_at(s_mm)

    def moved(by):
        return twist(solved(change(scene, by), tolerance_mm=1e-9), base, s_mm)

    return (8 * (moved(step) - moved(-step)) - (moved(2 * step) - moved(-2 * step))) / (12 * step)


def with_number(*path):
    def change(scene, by):
        if not path:
            return scene
        step, rest = path[0], path[1:]
        copy = dict(scene) if isinstance(scene, dict) else list(scene)
        copy[step] = with_number(*rest)(scene[step], by) if rest else scene[step] + by
        return copy
    return change


@pytest.mark.parametrize("s_mm", [40.0, 22.5])
@pytest.mark.parametrize("parameter, path, step", [
    (("load", FORCE, "y"), ("loads", FORCE, "value_N", 1), 1e-3),
    (("load", TENDON, "tension"), ("loads", TENDON, "tension_N"), 1e-2),
    (("load", GRAVITY, "z"), ("loads", GRAVITY, "acceleration_m_per_s2", 2), 1e-1),
    (("load", MOMENT, "x"), ("loads", MOMENT, "value_Nmm", 0), 1e-1),
    (("load", DISTRIBUTED, "z"), ("loads", DISTRIBUTED, "value_N_per_mm", 2), 1e-4),
    (("rest_curvature", 1, "z"), ("rod", "sections", 1, "rest_curvature_per_mm", 2), 1e-4),
    (("stiffness", 1, "EI_z"), ("rod", "sections", 1, "stiffness", "bending_Nmm2", 1), 1),
    (("stiffness", 0, "GJ"), ("rod", "sections", 0, "stiffness", "torsion_Nmm2"), 1),
    (("place", MOMENT), ("loads", MOMENT, "at"), 1e-2)])
def test_slopes_against_differences(rod, parameter, path, step, s_mm):
    """To 1e-4 of the largest entry: differences of answers that are known to 1e-9 mm. (Tighter in C++.)"""
    rod["rod"]["sections"][1]["rest_curvature_per_mm"] = [0, 0, 0.01]
    solver = solved(rod, tolerance_mm=1e-9)
    slope = solver.jacobian(s_mm, [parameter])[:, 0]
    expected = difference(rod, with_number(*path), step, s_mm)
    size = np.abs(expected).max()
    assert np.abs(slope - expected).max() < 1e-4 * size
    assert np.abs(1.05 * slope - expected).max() > 1e-3 * size


def test_columns_of_the_jacobian_are_the_slopes(rod):
    solver = solved(rod)
    places = [10, 40]
    of = {("load", FORCE): solver.by_load, ("load", TENDON): solver.by_load, ("rest_curvature", 1): solver.by_rest_curvature,
          ("stiffness", 0): solver.by_stiffness, ("place", MOMENT): solver.by_place}
    names = {"load": "xyz", "rest_curvature": "xyz", "stiffness": ("GJ", "EI_y", "EI_z")}
    for (kind, index), slopes in of.items():
        parameters = ([("load", TENDON, "tension")] if (kind, index) == ("load", TENDON) else [("place", index)]
                      if kind == "place" else [(kind, index, name) for name in names[kind]])
        jacobian = solver.jacobian(places, parameters)
        assert jacobian.shape == (12, len(parameters))
        expected = np.vstack([np.reshape(slopes(index, s), (6, -1)) for s in places])
        assert np.isfinite(expected).all()
        assert np.abs(jacobian - expected).max() <= 1e-12 * np.abs(expected).max()


def test_slopes_that_take_more_arcs_than_reserved_raise():
    circle = {"rod": {"sections": [{"length_mm": 100, "stiffness": {"bending_Nmm2": 1500, "torsion_Nmm2": 1000}}]},
              "loads": [{"kind": "moment", "at": "tip", "frame": "fixed", "value_Nmm": [0, 0, 100]}]}
    for reserved, solves in ((2, False), (2000, True)):
        solver = fam.Solver(circle, tolerance_mm=1e-6, reserved_arcs=reserved)
        assert solver.solve().status == "converged" and len(solver.s_mm) == 2
        for ask in (lambda: solver.by_load(0, 100), lambda: solver.compliance(100), lambda: solver.by_stiffness(0, 100),
                    lambda: solver.by_place(0, 50), lambda: solver.jacobian([100], [("load", 0, "z")])):
            if solves:
                assert np.isfinite(ask()).all()
            else:
                with pytest.raises(RuntimeError, match="reserved_arcs"):
                    ask()


def test_shapes_of_slopes(rod):
    solver = solved(rod)
    for quantity in "", "strain_", "wrench_":
        get = lambda name, *of: getattr(solver, quantity + name)(*of, 20)
        assert get("compliance").shape == (6, 6)
        assert get("by_load", FORCE).shape == (6, 3) and get("by_load", TENDON).shape == (6, 1)
        assert get("by_rest_curvature", 0).shape == (6, 3) and get("by_stiffness", 1).shape == (6, 3)
        assert get("by_place", MOMENT).shape == (6,)
    assert solver.jacobian([], [("place", 0)]).shape == (0, 1) and solver.jacobian([1, 2], []).shape == (12, 0)


def test_equilibrium_of_slopes(rod):
    """The force at the clamp is the sum of the loads, whatever the shape: its slope by a fixed force is 1."""
    solver = solved(rod, tolerance_mm=1e-9)
    rod["loads"] = [rod["loads"][FORCE]]
    solver = solved(rod, tolerance_mm=1e-9)
    assert np.abs(solver.wrench_by_load(0, 0)[:3] - np.eye(3)).max() < 1e-7
    assert np.abs(solver.compliance(LENGTH_MM)[:, :3] - solver.by_load(0, LENGTH_MM)).max() < 1e-9
    compliance = solver.compliance(LENGTH_MM)
    assert np.abs(compliance - compliance.T).max() < 1e-7 * np.abs(compliance).max()
