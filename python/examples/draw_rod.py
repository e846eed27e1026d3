"""Draws a catheter that two tendons and its weight bend: `draw_rod.py rod.png`, or without a name in a window."""

import os
import sys

import matplotlib

if len(sys.argv) > 1 or not os.environ.get("DISPLAY"):
    matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import fam

scene = {
    "title": "catheter with two tendons",
    "rod": {"sections": [{"length_mm": 200, "geometry": {"outer_diameter_mm": 2.14, "inner_diameter_mm": 1.56},
                          "material": {"youngs_modulus_MPa": 1592.3, "poissons_ratio": 0.395,
                                       "density_kg_per_m3": 1100}}]},
    "loads": [{"kind": "gravity", "acceleration_m_per_s2": [0, 0, -9.81]},
              {"kind": "tendon", "offset_mm": [0.7, 0], "tension_N": 0},
              {"kind": "tendon", "offset_mm": [0, 0.7], "tension_N": 0, "to_mm": 100}],
}
length_mm = scene["rod"]["sections"][0]["length_mm"]

figure = plt.figure(figsize=(7, 6))
axes = figure.add_subplot(projection="3d")
for tension_N in np.linspace(0, 20, 5):
    scene["loads"][1]["tension_N"] = tension_N
    scene["loads"][2]["tension_N"] = 2 * tension_N
    rod = fam.solve(scene)
    if not rod.converged:
        sys.exit(f"{tension_N} N: {rod.status}: {rod.message}")
    axes.plot(*rod.position_mm.T, label=f"{tension_N:.0f} N and {2 * tension_N:.0f} N")
    axes.quiver(*rod.tip_position_mm, *rod.tip_rotation[:, 0], length=0.06 * length_mm, color="black")  # tip tangent
    print(f"{tension_N:4.0f} N: tip at {np.round(rod.tip_position_mm, 3)} mm, within {rod.error_estimate_mm:.2g} mm")

axes.set_title(scene["title"], loc="left")
axes.set(ylabel="y, mm", zlabel="z, mm")
axes.set_xlabel("x, mm", labelpad=16)
axes.set_box_aspect([np.ptp(axes.get_w_lims()[2 * i:2 * i + 2]) for i in range(3)])  # the same scale on all axes
axes.legend(title="tensions", loc="upper left", bbox_to_anchor=(0.7, 1.05))
if len(sys.argv) > 1:
    figure.savefig(sys.argv[1], dpi=150, bbox_inches="tight")
else:
    plt.show()
