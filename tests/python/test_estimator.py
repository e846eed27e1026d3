"""fam.estimate and fam.Estimator beside fam.solve of the same loads, and what they refuse."""

import json

import fam
import numpy as np
import pytest

FORCE_N = np.array([0.1, 0.5, -0.3])


def rod(force_N):
    stiffness = {"bending_Nmm2": 1500, "torsion_Nmm2": 1000}
    return {"rod": {"sections": [{"length_mm": 40, "stiffness": stiffness}]},
            "loads": [{"kind": "force", "at": "tip", "frame": "fixed", "value_N": force_N}]}


def problem(tip_mm, sd_mm=0.01):
    return {"scene": rod([0, 0, 0]), "unknowns": [{"load": 0, "component": c} for c in "xyz"],
            "measurements": [{"kind": "position", "at": "tip", "value_mm": tip_mm, "sd_mm": sd_mm}]}


def tip_of(force_N):
    return fam.solve(rod(force_N), tolerance_mm=1e-9).tip_position_mm


def test_finds_the_force_that_bent_the_rod():
    found = fam.estimate(problem(tip_of(FORCE_N)))
    assert found.converged and found.fits and found.message == ""
    assert found.names == ["loads[0].x, N", "loads[0].y, N", "loads[0].z, N"]
    assert found.observable == [True] * 3
    # 1e-3 N asked, 2e-5 measured; the tips of forces 5 % larger are 0.4 mm away
    np.testing.assert_allclose(found.mean, FORCE_N, atol=1e-3)
    np.testing.assert_allclose(found.sd**2, np.diag(found.covariance))
    stiffer = fam.estimate(problem(tip_of(1.05 * FORCE_N)))
    assert np.linalg.norm(stiffer.mean - FORCE_N) > 0.02


def test_any_form_of_the_problem_says_the_same(tmp_path):
    asked = problem(tip_of(FORCE_N).tolist())
    text = json.dumps(asked)
    file = tmp_path / "problem.json"
    file.write_text(text)
    means = [fam.estimate(form).mean for form in (asked, text, str(file), file)]
    for mean in means[1:]:
        np.testing.assert_array_equal(mean, means[0])


def test_a_stream_follows_the_measurements():
    estimator = fam.Estimator(problem(tip_of(FORCE_N)))
    estimator.estimate()
    for share in (0.8, 0.6, 0.9):
        estimator.set_measurement(0, tip_of(share * FORCE_N))
        np.testing.assert_allclose(estimator.estimate().mean, share * FORCE_N, atol=2e-3)


def test_what_cannot_be_observed_is_not_a_number():
    straight = problem([40, 0, 0])
    found = fam.estimate(straight)
    assert found.observable == [False, True, True]
    assert np.isnan(found.mean[0]) and np.isnan(found.sd[0])
    np.testing.assert_allclose(np.abs(found.unobservable), [[1, 0, 0]], atol=1e-6)


@pytest.mark.parametrize("change, words", [
    (lambda p: p.update(unknowns=[]), "unknowns"),
    (lambda p: p["unknowns"][1].update(component="w"), "unknowns[1].component"),
    (lambda p: p["measurements"][0].update(sd_mm=0), "measurements[0].sd_mm"),
    (lambda p: p["measurements"][0].update(at=41), "measurements[0].at"),
    (lambda p: p["measurements"][0].update(sd_mm=object()), "problem: measurements[0].sd_mm"),
])
def test_wrong_problems_are_refused_in_one_line(change, words):
    asked = problem([40, 0, 0])
    change(asked)
    with pytest.raises(fam.SceneError) as refusal:
        fam.estimate(asked)
    assert words in str(refusal.value) and "\n" not in str(refusal.value)
    assert isinstance(refusal.value, ValueError)


def test_wrong_measurements_are_refused_and_leave_the_estimator():
    estimator = fam.Estimator(problem(tip_of(FORCE_N)))
    for wrong in ([1, 2], "text", [1, 2, np.nan], np.eye(3)):
        with pytest.raises(fam.SceneError, match=r"measurements\[0\].value"):
            estimator.set_measurement(0, wrong)
    with pytest.raises(IndexError):
        estimator.set_measurement(1, [40, 0, 0])
    with pytest.raises(IndexError):
        estimator.set_measurement(0, [40, 0, 0], scene=1)
    np.testing.assert_allclose(estimator.estimate().mean, FORCE_N, atol=1e-3)
