"""fam.solve_batch: the rows of a Solver, no copies, wrong input."""

import math
import threading

import numpy as np
import pytest

import fam

COLUMNS = [(0, "x"), (0, "y"), (1, "tension"), (2, "z")]


def values(rows):
    random = np.random.default_rng(15)
    return random.uniform([-0.5, -0.5, 0, -9.81], [0.5, 0.5, 4, 9.81], (rows, 4))


def test_rows_are_those_of_a_solver(rod):
    rod["loads"][0]["value_N"][2] = 3  # too large for lanes, which end Newton's method elsewhere
    r = fam.solve_batch(rod, columns=COLUMNS, values=values(20))
    assert r.position_mm.shape == (20, 3) and r.rotation_wxyz.shape == (20, 4)
    assert r.status == ["converged"] * 20 and r.error_estimate_mm.shape == (20,)
    solver = fam.Solver(rod)
    for k, (x, y, tension_N, z) in enumerate(values(20)):
        solver.set_force_N(0, [x, y, 3])
        solver.set_tension_N(1, tension_N)
        solver.set_acceleration_m_per_s2(2, [0, 0, z])
        assert solver.solve("unloaded").converged
        assert np.array_equal(r.position_mm[k], solver.tip_position_mm)
        assert r.error_estimate_mm[k] == solver.error_estimate_mm()
        w, *v = r.rotation_wxyz[k]
        cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
        rotation = np.eye(3) + 2 * w * cross + 2 * cross @ cross
        assert w >= 0 and np.abs(rotation - solver.tip_rotation).max() < 1e-14
    assert np.ptp(r.position_mm, axis=0).min() > 0.1  # the values did arrive


def test_lanes_are_a_solver_to_round_off(rod):
    r = fam.solve_batch(rod, columns=COLUMNS, values=values(20), arcs=8)
    solver = fam.Solver(rod, arcs=8)
    for k, (x, y, tension_N, z) in enumerate(values(20)):
        solver.set_force_N(0, [x, y, 0.3])
        solver.set_tension_N(1, tension_N)
        solver.set_acceleration_m_per_s2(2, [0, 0, z])
        assert solver.solve("unloaded").converged
        assert np.abs(r.position_mm[k] - solver.tip_position_mm).max() < 1e-10  # measured: 2e-13


def test_arrays_as_they_come(rod):
    plain = values(6)
    expected = fam.solve_batch(rod, COLUMNS, plain).position_mm
    for same in plain.tolist(), np.asfortranarray(plain), np.hstack([plain, plain])[:, :4], plain.astype(np.longdouble):
        assert np.array_equal(fam.solve_batch(rod, COLUMNS, same).position_mm, expected)
    columns = [list(column) for column in COLUMNS], tuple(COLUMNS), [(np.int64(i), name) for i, name in COLUMNS]
    for same in columns:
        assert np.array_equal(fam.solve_batch(rod, same, plain).position_mm, expected)
    assert np.array_equal(fam.solve_batch(rod, COLUMNS, plain[::-1]).position_mm, expected[::-1])
    assert fam.solve_batch(rod, COLUMNS, np.zeros((0, 4))).position_mm.shape == (0, 3)
    whole = fam.solve_batch(rod, [(0, "x")], np.array([[1], [2]]))
    assert whole.status == ["converged"] * 2


def test_results_are_read_only_views(rod):
    r = fam.solve_batch(rod, COLUMNS, values(3))
    for array in r.position_mm, r.rotation_wxyz, r.error_estimate_mm:
        assert array.base is r
        with pytest.raises(ValueError):
            array[0] = 0


def test_a_row_that_fails_is_nan(rod):
    r = fam.solve_batch(rod, [(0, "y")], [[0.1], [500], [0.2]], arcs=1)  # too long an arc for 500 N
    assert [status == "converged" for status in r.status] == [True, False, True]
    assert np.isnan(r.position_mm[1]).all() and np.isnan(r.rotation_wxyz[1]).all() and math.isnan(r.error_estimate_mm[1])
    assert np.isfinite(r.position_mm[[0, 2]]).all()
    assert fam.solve_batch(rod, [(0, "y")], [[0.1]], law="published").status == ["unsupported"]


def test_options(rod):
    bare = fam.solve_batch(rod, COLUMNS, values(2), arcs=12, estimate=False)
    assert (bare.error_estimate_mm == 0).all()
    checked = fam.solve_batch(rod, COLUMNS, values(2), arcs=12)
    assert (checked.error_estimate_mm > 0).all() and np.array_equal(checked.position_mm, bare.position_mm)
    fine = fam.solve_batch(rod, COLUMNS, values(2), tolerance_mm=1e-7)
    assert (fine.error_estimate_mm <= 1e-7).all()


@pytest.mark.parametrize("columns, given, message", [
    ([(5, "x")], [[1]], "columns[0].load = 5: must name one of the scene's 5 loads, counted from 0"),
    ([(0, "x"), (-1, "x")], [[1, 1]], "columns[1].load = -1: must name one of the scene's 5 loads, counted from 0"),
    ([(0, "w")], [[1]], "columns[0].component = 'w': must be 'x', 'y' or 'z', of a force"),
    ([(0, "tension")], [[1]], "columns[0].component = 'tension': must be 'x', 'y' or 'z', of a force"),
    ([(1, "x")], [[1]], "columns[0].component = 'x': must be 'tension', of a tendon"),
    ([(0, "x"), (0, "x")], [[1, 1]], "columns[1] = {0, 0}: the column is given twice"),
    ([0], [[1]], "columns[0] = 0: must be a list of (load, 'x', 'y', 'z' or 'tension')"),
    ([("0", "x")], [[1]], "columns[0] = ('0', 'x'): must be a list of (load, 'x', 'y', 'z' or 'tension')"),
    ("x", [[1]], "columns = 'x': must be a list of (load, 'x', 'y', 'z' or 'tension')"),
    ([(0, "x")], [[1, 2]], "values = 2 columns: must have 1, one for each of columns"),
    ([(0, "x")], [1, 2], "values = [1, 2]: must be an array of numbers, (rods, columns)"),
    ([(0, "x")], [["a"]], "values = [['a']]: must be an array of numbers, (rods, columns)"),
    ([(0, "x")], np.array([[1 + 2j]]), "values = array([[1.+2.j]]): must be an array of numbers, (rods, columns)"),
    ([(0, "x")], [["1"]], "values = [['1']]: must be an array of numbers, (rods, columns)"),
    ([(0, "x")], [[1], [math.nan]], "values[1][0] = nan: must be finite"),
    ([(1, "tension")], [[1], [2], [-0.5]], "values[2][0] = -0.5: must be >= 0")])
def test_wrong_input(rod, columns, given, message):
    with pytest.raises(fam.SceneError) as error:
        fam.solve_batch(rod, columns, given)
    assert str(error.value) == message


def test_others_run_meanwhile(rod):
    """A thread goes on while a batch is solved."""
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1
            stop.wait(1e-4)

    other = threading.Thread(target=count)
    other.start()
    before = counted[0]
    fam.solve_batch(rod, COLUMNS, values(3000), arcs=24)
    during = counted[0] - before
    stop.set()
    other.join()
    assert during >= 2
