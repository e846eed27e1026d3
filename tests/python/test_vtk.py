"""Rods written for ParaView, read back by VTK's own reader."""

import csv
import io
import json
import xml.etree.ElementTree

import numpy as np
import pytest
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

from conftest import project

POLY_LINE = 4


def read(path):
    """Points, and point and cell arrays by their names."""
    assert path.exists()
    complaints = []
    reader = vtkXMLUnstructuredGridReader()
    reader.AddObserver("ErrorEvent", lambda *_: complaints.append("error"))
    reader.SetFileName(str(path))
    reader.Update()
    assert not complaints
    grid = reader.GetOutput()
    assert grid.GetNumberOfCells() == 1 and grid.GetCellType(0) == POLY_LINE
    points = grid.GetCell(0).GetPointIds()
    assert [points.GetId(i) for i in range(points.GetNumberOfIds())] == list(range(grid.GetNumberOfPoints()))

    def arrays(data):
        return {data.GetArrayName(i): vtk_to_numpy(data.GetArray(i)) for i in range(data.GetNumberOfArrays())}
    return vtk_to_numpy(grid.GetPoints().GetData()), arrays(grid.GetPointData()), arrays(grid.GetCellData())


def expect_same(path, solved):
    """Every digit of what `fam solve --format json` prints."""
    position, point, cell = read(path)
    line = solved["centreline"]
    assert position.dtype == np.float64
    assert np.array_equal(position, [station["position_mm"] for station in line])
    assert np.array_equal(point["s_mm"], [station["s_mm"] for station in line])
    assert np.array_equal(point["rotation"], [np.ravel(station["rotation"]) for station in line])
    assert np.array_equal(point["force_N"], [station["force_N"] for station in line])
    assert np.array_equal(point["moment_Nmm"], [station["moment_Nmm"] for station in line])
    assert cell["error_estimate_mm"] == [solved["error_estimate_mm"]]
    assert cell["stable"] == [{None: -1, False: 0, True: 1}[solved["stable"]]]
    return position, point, cell


def largest_miss(point, breaks_mm=()):
    """Largest difference of the curvatures' means from the turn between neighbouring stations, over the largest
    curvature: by the positions' frames alone, not by forces. Of intervals that begin at a break the near side's
    curvature is not told."""
    s, curvature = point["s_mm"], point["curvature_per_mm"]
    rotation = point["rotation"].reshape(-1, 3, 3)
    misses = []
    for i in range(len(s) - 1):
        turn = rotation[i].T @ rotation[i + 1]
        sine = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]) / 2
        angle = np.arcsin(np.linalg.norm(sine))
        vector = sine * (angle / np.sin(angle) if angle > 0 else 1)
        if not np.any(np.isclose(s[i], breaks_mm, rtol=1e-12)):
            misses.append(np.abs((curvature[i] + curvature[i + 1]) / 2 - vector / (s[i + 1] - s[i])).max())
    return max(misses) / np.abs(curvature).max()


@pytest.mark.parametrize("case", ["study1/S4_follower", "robots/catheter_tube", "robots/tendon_arm_three_sections",
                                  "robots/guidewire_j_tip"])
def test_arrays_are_those_of_solve(case, command, tmp_path):
    path = project / f"studies/cases/{case}.json"
    status, printed, _ = command("solve", path, "--format", "json", "--tolerance-mm", "1e-5", "--vtu", tmp_path / "rod.vtu")
    assert status == 0
    _, point, _ = expect_same(tmp_path / "rod.vtu", json.loads(printed))
    scene = json.loads(path.read_text())
    breaks_mm = list(np.cumsum([section["length_mm"] for section in scene["rod"]["sections"]]))
    breaks_mm += [load["at"] for load in scene["loads"] if load.get("at", "tip") != "tip"]
    # A mean of two ends is off by h^2/12 of the second derivative: measured <= 4e-4; 5 % off the bending stiffness: >= 4e-2.
    assert largest_miss(point, breaks_mm) < 1e-3
    point["curvature_per_mm"] = point["curvature_per_mm"] * [1, 1.05, 1.05]
    assert largest_miss(point, breaks_mm) > 2e-2


def test_curvature_and_radius_of_a_circle(circle, command, tmp_path):
    def solved(scene):
        status, printed, _ = command("solve", "-", "--format", "json", "--vtu", tmp_path / "new" / "rod.vtu",
                                     input=json.dumps(scene))
        assert status == 0
        return expect_same(tmp_path / "new" / "rod.vtu", json.loads(printed))
    _, point, _ = solved(circle)
    assert np.allclose(point["curvature_per_mm"], [0, 0, 0.01], rtol=0, atol=1e-15)
    assert np.all(point["radius_mm"] == 1)  # no diameter is told: drawn with a hundredth of the length
    stiff, tube = circle["rod"]["sections"][0], {
        "length_mm": 50, "geometry": {"outer_diameter_mm": 5, "inner_diameter_mm": 3}, "rest_curvature_per_mm": [0, 0.02, 0],
        "material": {"youngs_modulus_MPa": 10, "poissons_ratio": 0.3}}
    _, point, _ = solved({"rod": {"sections": [tube, {**stiff, "length_mm": 30}]},
                          "loads": [{"kind": "moment", "at": "tip", "frame": "follower", "value_Nmm": [0, 15, 0]}]})
    of_tube = point["s_mm"] <= 50  # at 50 mm itself the side towards the clamp
    assert np.all(point["radius_mm"] == np.where(of_tube, 2.5, 0.8))
    bent = 0.02 + 15 / (10 * np.pi * (5**4 - 3**4) / 64)
    assert np.allclose(point["curvature_per_mm"][:, 1], np.where(of_tube, bent, 0.01), rtol=1e-12, atol=0)


def test_a_failed_solve_writes_nothing(command, tmp_path):
    status, _, error = command("solve", project / "studies/cases/study1/S4_fixed.json", "--law", "published",
                               "--vtu", tmp_path / "rod.vtu")
    assert status == 1 and "unsupported" in error
    status, _, error = command("solve", "-", "--vtu", tmp_path / "rod.vtu", input="{")
    assert status == 2
    assert list(tmp_path.iterdir()) == []


def rods_of(pvd):
    """Time step and file of each rod of a collection."""
    root = xml.etree.ElementTree.parse(pvd).getroot()
    assert root.get("type") == "Collection"
    return {int(rod.get("timestep")): pvd.parent / rod.get("file") for rod in root.iter("DataSet")}


def test_path(command, tmp_path):
    path = project / "studies/cases/paths/turned_clamp.json"
    status, printed, _ = command("path", path, "--format", "json", "--tolerance-mm", "1e-6",
                                 "--pvd", tmp_path / "turned & more.pvd")
    assert status == 0
    points = json.loads(printed)["points"]
    rods = rods_of(tmp_path / "turned & more.pvd")
    assert list(rods) == list(range(len(points))) and any(point["kind"] == "fold" for point in points)
    load = json.loads(path.read_text())["scene"]["loads"][0]
    for i, expected in enumerate(points):
        position, point, cell = read(rods[i])
        assert np.allclose(position[-1], expected["tip_position_mm"], rtol=0, atol=1e-12)
        assert cell["parameter"] == [expected["parameter"]] and cell["branch"] == [expected["branch"]]
        assert cell["stable"] == [{None: -1, False: 0, True: 1}[expected["stable"]]]
        assert 0 < cell["error_estimate_mm"][0] < 1e-6
        sine, cosine = np.sin(expected["parameter"]), np.cos(expected["parameter"])
        turned_N = np.array([[1, 0, 0], [0, cosine, -sine], [0, sine, cosine]]) @ load["value_N"]
        assert np.allclose(point["force_N"], turned_N, rtol=0, atol=1e-12)
        assert largest_miss(point) < 2e-3  # measured <= 6e-4; 5 % off the bending stiffness: >= 4e-2


def test_path_of_rest_curvatures(command, tmp_path):
    assert command("path", project / "studies/cases/paths/curl.json", "--tolerance-mm", "1e-4",
                   "--pvd", tmp_path / "rods.pvd")[0] == 0
    misses = [largest_miss(read(path)[1]) for path in list(rods_of(tmp_path / "rods.pvd").values())[1:]]
    assert len(misses) > 20 and max(misses) < 5e-3  # measured <= 1.7e-3


def test_path_starts_with_what_solve_finds(command, tmp_path):
    path = project / "studies/cases/paths/finger.json"
    assert command("path", path, "--tolerance-mm", "1e-7", "--pvd", tmp_path / "rods.pvd")[0] == 0
    scene = json.loads(path.read_text())["scene"]  # its parameter is the tendon's tension, from 0 on
    scene["loads"][1]["tension_N"] = 0
    position, point, cell = read(rods_of(tmp_path / "rods.pvd")[0])
    assert cell["parameter"] == [0]
    _, printed, _ = command("solve", "-", "--tolerance-mm", "1e-7", "--format", "json", input=json.dumps(scene))
    solved = {round(station["s_mm"], 9): station for station in json.loads(printed)["centreline"]}
    common = {i: round(s_mm, 9) for i, s_mm in enumerate(point["s_mm"]) if round(s_mm, 9) in solved}
    assert len(common) >= 41
    for i, s_mm in common.items():
        assert np.allclose(position[i], solved[s_mm]["position_mm"], rtol=0, atol=2e-7)
        # Two solutions within 1e-7 mm of the exact one; measured: 2e-9 mm and 1.4e-9 of 55 N mm.
        assert np.allclose(point["moment_Nmm"][i], solved[s_mm]["moment_Nmm"], rtol=0, atol=1e-7)


def test_batch(rod, command, tmp_path):
    (tmp_path / "rod.json").write_text(json.dumps(rod))
    values = "0.z,1.tension\n0,1\n1e9,1\n-0.2,3\n"
    status, printed, _ = command("batch", tmp_path / "rod.json", "--values", "-", "--tolerance-mm", "1e-9", "--pvd",
                                 tmp_path / "rods.pvd", input=values)
    rows = list(csv.DictReader(io.StringIO(printed)))
    assert status == 1 and [row["status"] == "converged" for row in rows] == [True, False, True]
    rods = rods_of(tmp_path / "rods.pvd")
    assert list(rods) == [0, 2]  # the row that was not solved has no rod
    for row, path in rods.items():
        position, _, _ = read(path)
        expected_mm = [float(rows[row][key]) for key in ("x_mm", "y_mm", "z_mm")]
        assert np.allclose(position[-1], expected_mm, rtol=0, atol=2e-9)


def test_the_same_bytes_again(command, tmp_path):
    case = project / "studies/cases/study1/S4_fixed.json"
    for name in ("one.vtu", "two.vtu"):
        assert command("solve", case, "--vtu", tmp_path / name)[0] == 0
    assert (tmp_path / "one.vtu").read_bytes() == (tmp_path / "two.vtu").read_bytes()


def test_tubes_of_the_recipe(command, tmp_path):
    from vtkmodules.vtkFiltersCore import vtkTubeFilter
    from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter

    assert command("solve", project / "studies/cases/robots/colonoscope.json", "--vtu", tmp_path / "rod.vtu")[0] == 0
    rod = vtkXMLUnstructuredGridReader()
    rod.SetFileName(str(tmp_path / "rod.vtu"))
    lines = vtkGeometryFilter()
    lines.SetInputConnection(rod.GetOutputPort())
    tube = vtkTubeFilter()
    tube.SetNumberOfSides(24)
    tube.SetInputConnection(lines.GetOutputPort())
    tube.SetInputArrayToProcess(0, 0, 0, 0, "radius_mm")
    tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
    tube.Update()
    surface = vtk_to_numpy(tube.GetOutput().GetPoints().GetData()).astype(float)
    position, point, _ = read(tmp_path / "rod.vtu")
    assert len(surface) == 24 * len(position)
    away_mm = np.linalg.norm(surface.reshape(-1, 24, 3) - position[:, None, :], axis=2)
    assert np.allclose(away_mm, point["radius_mm"][:, None], rtol=1e-3, atol=0)  # single precision
