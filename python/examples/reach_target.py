"""Moves a catheter's tip to targets by the tensions of its three tendons: Newton's steps with the Jacobian, damped.

A step is solved from the last solution, so the rod stays on its branch; tendons can only pull.
"""

import sys

import numpy as np

import fam

length_mm = 100.0
angles = 2 * np.pi * np.arange(3) / 3
scene = {
    "title": "catheter with three tendons and its weight",
    "rod": {"sections": [{"length_mm": length_mm,
                          "stiffness": {"bending_Nmm2": 1500, "torsion_Nmm2": 1200, "mass_per_length_kg_per_m": 0.02}}]},
    "loads": [{"kind": "tendon", "offset_mm": [2 * np.cos(a), 2 * np.sin(a)], "tension_N": 2} for a in angles]
    + [{"kind": "gravity", "acceleration_m_per_s2": [0, 0, -9.81]}],
}


def reach(solver, tensions_N, target_mm, close_enough_mm=1e-6):
    """Tensions that hold the tip's y and z at the target; how many solves that took."""
    for solves in range(1, 50):
        for tendon, tension_N in enumerate(tensions_N):
            solver.set_tension_N(tendon, tension_N)
        outcome = solver.solve()
        if not outcome.converged:
            sys.exit(f"{outcome.status}: {outcome.message}")
        miss_mm = target_mm - solver.tip_position_mm[1:]
        if np.linalg.norm(miss_mm) < close_enough_mm:
            return tensions_N, solves
        jacobian = solver.jacobian(length_mm, [("load", tendon, "tension") for tendon in range(3)])[1:3]  # of y and z
        step_N = np.linalg.lstsq(jacobian, miss_mm, rcond=None)[0]
        step_N *= min(1, 5 / np.abs(step_N).max())
        tensions_N = tensions_N + step_N
        tensions_N += max(0, 0.5 - tensions_N.min())  # pulling all three alike hardly moves the tip
    sys.exit(f"the target {target_mm} mm is out of reach")


solver = fam.Solver(scene, tolerance_mm=1e-3)
tensions_N = np.full(3, 2.0)
for target_mm in 20 * np.column_stack([np.cos(angles + 0.4), np.sin(angles + 0.4)]):
    tensions_N, solves = reach(solver, tensions_N, target_mm)
    print(f"y, z = {np.round(target_mm, 2)} mm with {np.round(tensions_N, 3)} N after {solves} solves, "
          f"model within {solver.error_estimate_mm():.1g} mm")
