"""The finite arc method: static shapes of clamped slender rods.

Units: mm, N, N mm, rad. Base frame: at the clamp, x along the undeformed rod; section frame: x along the section's
normal. Rotations have the section's axes in their columns. Scenes: docs/scene_format.md of the project.
"""

import os
from typing import Any, Literal, Sequence, final

import numpy as np
from numpy.typing import ArrayLike, NDArray

_Array = NDArray[np.float64]
_Scene = dict[str, Any] | str | os.PathLike[str]
"""A dict in the scene format (numpy's arrays and numbers welcome), its JSON text, or the path of a scene file."""
_Law = Literal["auto", "published", "midpoint", "fourth_order", "sixth_order"]
_Model = Literal["auto", "kirchhoff", "reissner"]
_Parameter = (
    tuple[Literal["load"], int, Literal["x", "y", "z", "tension"]]
    | tuple[Literal["rest_curvature"], int, Literal["x", "y", "z"]]
    | tuple[Literal["stiffness"], int, Literal["GJ", "EI_y", "EI_z"]]
    | tuple[Literal["place"], int]
)

__version__: str

class SceneError(ValueError):
    """Wrong input: one line, what, where and what is allowed. The line that the commands print."""

def solve(
    scene: _Scene,
    tolerance_mm: float | None = None,
    arcs: int | None = None,
    law: _Law = "auto",
    model: _Model = "auto",
) -> Equilibrium:
    """Solves one scene.

    tolerance_mm: largest error of any place along the rod, mm; None: 1e-3 of the length.
    arcs: in place of a tolerance, the number of arcs.

    Raises SceneError on wrong input. A solve that fails does not raise: its `converged` is False, `status` says why.
    """

def solve_batch(
    scene: _Scene,
    columns: Sequence[tuple[int, Literal["x", "y", "z", "tension"]]],
    values: ArrayLike,
    tolerance_mm: float | None = None,
    arcs: int | None = None,
    estimate: bool = True,
    law: _Law = "auto",
    model: _Model = "auto",
    threads: int = 1,
) -> BatchResult:
    """Solves one scene for many values of its loads, a row each.

    columns: which number of the scene each column of values replaces: (load, 'x'), ..., of a tendon (load, 'tension').
    values: (n, columns), N, N mm, N/mm or m/s^2 as the load has it; a C-contiguous float64 array is not copied.
    estimate: False leaves the error estimates out. threads: that share the rows; 0: as many as the machine runs at once.
    The others as of `solve`.

    Each row is a cold solve, whatever the order of the rows; one whose error estimate exceeds the tolerance has
    'tolerance_not_met'. Raises SceneError on wrong input, before anything is solved. Other threads run meanwhile.
    """

@final
class Equilibrium:
    """Static equilibrium of a scene, as `solve` gives it.

    Arrays along the rod go from clamp to tip and are read-only views; base frame. Only a converged one has a shape:
    else those arrays are empty and the values at tip and clamp NaN.
    """

    @property
    def status(self) -> str:
        """'converged', or why not."""
    @property
    def converged(self) -> bool: ...
    @property
    def message(self) -> str:
        """One line, why not converged; empty when converged."""
    @property
    def stable(self) -> bool | None:
        """Whether the rod would stay; None: not decided, or the loads have no energy."""
    @property
    def error_estimate_mm(self) -> float:
        """Of the position of any station, mm."""
    @property
    def model(self) -> dict[str, bool | int | float | str]:
        """What was solved and how: law, arcs, planar, torsion, shear, solver, reason, ..."""
    @property
    def tip_position_mm(self) -> _Array:
        """(3,), mm."""
    @property
    def tip_rotation(self) -> _Array:
        """(3, 3)."""
    @property
    def tip_angle_rad(self) -> float:
        """The tip's turn, rad: of planar scenes about the plane's normal, full turns counted; else 0 to pi."""
    @property
    def base_force_N(self) -> _Array:
        """(3,), N: the rod's own internal force at the clamp."""
    @property
    def base_moment_Nmm(self) -> _Array:
        """(3,), N mm: the rod's own internal moment at the clamp."""
    @property
    def tendon_shortening_mm(self) -> _Array:
        """(tendons,), mm: how much of each leaves through the clamp."""
    @property
    def s_mm(self) -> _Array:
        """(n,), mm: arc lengths of the stations."""
    @property
    def position_mm(self) -> _Array:
        """(n, 3), mm."""
    @property
    def rotation(self) -> _Array:
        """(n, 3, 3)."""
    @property
    def force_N(self) -> _Array:
        """(n, 3), N: the rod's own internal force; at a load that of the side towards the clamp."""
    @property
    def moment_Nmm(self) -> _Array:
        """(n, 3), N mm: the rod's own internal moment; at a load that of the side towards the clamp."""

@final
class BatchResult:
    """What `solve_batch` gives: a row for each row of its values.

    The numbers of a row that did not converge are NaN. Arrays are read-only views.
    """

    @property
    def position_mm(self) -> _Array:
        """(n, 3), mm: of the tip, base frame."""
    @property
    def rotation_wxyz(self) -> _Array:
        """(n, 4): unit quaternions, w >= 0, of the tip's section frame in the base frame."""
    @property
    def status(self) -> list[str]:
        """'converged', or why not."""
    @property
    def error_estimate_mm(self) -> _Array:
        """(n,), mm: of any position along the rod; 0 where no estimate was asked for."""

@final
class Outcome:
    """How a `Solver.solve` ended."""

    @property
    def status(self) -> str:
        """'converged', or why not; 'limit_point': a fold on the way from the last solution."""
    @property
    def converged(self) -> bool: ...
    @property
    def load_steps(self) -> int: ...
    @property
    def newton_steps(self) -> int: ...
    @property
    def message(self) -> str:
        """One line; empty when converged."""

@final
class Solver:
    """One rod, solved again and again as its loads change.

    set_... give new values, as lists, tuples or arrays, and raise SceneError on wrong ones, which leaves the solver as it
    was. Getters speak of the solution found last, and copy; before there is one they raise RuntimeError, for an s off
    the rod ValueError, for a load or section that is not there IndexError. One solver only in one thread at a time (a
    second one gets RuntimeError); others run while it solves.

    Slopes are exact derivatives of the equilibrium, all else held, at the place s, mm from the clamp. Rows of the pose:
    position (mm), rotation (rad; dR R^T = [d rotation]x), base frame; of the strain: u (1/mm), v, section frame; of the
    rod's own wrench: force (N), moment (N mm), base frame.
    """

    def __init__(
        self,
        scene: _Scene,
        tolerance_mm: float | None = None,
        arcs: int | None = None,
        law: _Law = "auto",
        model: _Model = "auto",
        reserved_arcs: int = 1024,
    ) -> None:
        """As `solve`. reserved_arcs: memory is taken for so many, those of the error estimate included.

        Raises RuntimeError where the law cannot solve such a scene.
        """
    def set_force_N(self, load: int, value: ArrayLike) -> None:
        """(3,), N, of a force, in its frame."""
    def set_moment_Nmm(self, load: int, value: ArrayLike) -> None:
        """(3,), N mm, of a moment, in its frame."""
    def set_distributed_N_per_mm(self, load: int, value: ArrayLike) -> None:
        """(3,), N/mm, of a distributed force, in its frame."""
    def set_acceleration_m_per_s2(self, load: int, value: ArrayLike) -> None:
        """(3,), m/s^2, of gravity, base frame."""
    def set_tension_N(self, load: int, value: float) -> None:
        """N, >= 0, of a tendon."""
    def set_at_mm(self, load: int, value: float) -> None:
        """mm from the clamp: where a force or a moment acts from now on."""
    def set_rest_curvature_per_mm(self, section: int, value: ArrayLike) -> None:
        """(3,), 1/mm: torsion, bending about y, about z."""
    def set_stiffness_Nmm2(self, section: int, value: ArrayLike) -> None:
        """(3,), N mm^2: GJ, EI_y, EI_z."""
    def solve(self, start: Literal["last", "unloaded"] = "last", newton_steps_at_most: int = 3000) -> Outcome:
        """Solves for the values set.

        'last': on from the loads solved last, along the straight line between, on their branch; 'unloaded': the
        equilibrium that the rod reaches when all loads grow together from zero. Unless it converges the last solution
        stays. newton_steps_at_most: while loads grow; more end it in work_limit.
        """
    @property
    def solved(self) -> bool:
        """There is a solution."""
    def error_estimate_mm(self) -> float:
        """Of any position along the rod, mm: solves at a second resolution; infinite where that fails."""
    @property
    def stable(self) -> bool | None:
        """Whether the rod would stay; None: not decided, or the loads have no energy."""
    @property
    def tip_position_mm(self) -> _Array:
        """(3,), mm."""
    @property
    def tip_rotation(self) -> _Array:
        """(3, 3)."""
    @property
    def base_force_N(self) -> _Array:
        """(3,), N: the rod's own internal force at the clamp."""
    @property
    def base_moment_Nmm(self) -> _Array:
        """(3,), N mm: the rod's own internal moment at the clamp."""
    @property
    def s_mm(self) -> _Array:
        """(n,), mm: the arcs' ends, clamp to tip."""
    @property
    def position_mm(self) -> _Array:
        """(n, 3), mm."""
    @property
    def rotation(self) -> _Array:
        """(n, 3, 3)."""
    @property
    def force_N(self) -> _Array:
        """(n, 3), N: the rod's own internal force, base frame."""
    @property
    def moment_Nmm(self) -> _Array:
        """(n, 3), N mm: the rod's own internal moment, base frame."""
    def pose_at(self, s_mm: float) -> tuple[_Array, _Array]:
        """Position (3,), mm, and rotation (3, 3), anywhere along the rod."""
    def wrench_at(self, s_mm: float) -> tuple[_Array, _Array]:
        """The rod's own internal force (3,), N, and moment (3,), N mm, base frame, anywhere along the rod."""
    def compliance(self, s_mm: float) -> _Array:
        """(6, 6): of the pose, by a small fixed force (N), then moment (N mm), at the tip, base frame."""
    def by_load(self, load: int, s_mm: float) -> _Array:
        """(6, 3): of the pose, by the load's value; of a tendon (6, 1), by its tension."""
    def by_rest_curvature(self, section: int, s_mm: float) -> _Array:
        """(6, 3): of the pose, by torsion, bending about y, about z, 1/mm."""
    def by_stiffness(self, section: int, s_mm: float) -> _Array:
        """(6, 3): of the pose, by GJ, EI_y, EI_z, N mm^2."""
    def by_place(self, load: int, s_mm: float) -> _Array:
        """(6,): of the pose, by where a force or a moment acts, mm. ValueError for other loads."""
    def strain_compliance(self, s_mm: float) -> _Array:
        """(6, 6): of the strain, as `compliance`."""
    def strain_by_load(self, load: int, s_mm: float) -> _Array:
        """(6, 3) or (6, 1): of the strain, as `by_load`."""
    def strain_by_rest_curvature(self, section: int, s_mm: float) -> _Array:
        """(6, 3): of the strain, as `by_rest_curvature`."""
    def strain_by_stiffness(self, section: int, s_mm: float) -> _Array:
        """(6, 3): of the strain, as `by_stiffness`."""
    def strain_by_place(self, load: int, s_mm: float) -> _Array:
        """(6,): of the strain, as `by_place`."""
    def wrench_compliance(self, s_mm: float) -> _Array:
        """(6, 6): of the rod's own wrench, as `compliance`; at s = 0 of the base wrench."""
    def wrench_by_load(self, load: int, s_mm: float) -> _Array:
        """(6, 3) or (6, 1): of the rod's own wrench, as `by_load`."""
    def wrench_by_rest_curvature(self, section: int, s_mm: float) -> _Array:
        """(6, 3): of the rod's own wrench, as `by_rest_curvature`."""
    def wrench_by_stiffness(self, section: int, s_mm: float) -> _Array:
        """(6, 3): of the rod's own wrench, as `by_stiffness`."""
    def wrench_by_place(self, load: int, s_mm: float) -> _Array:
        """(6,): of the rod's own wrench, as `by_place`."""
    def jacobian(self, s_mm: ArrayLike, parameters: Sequence[_Parameter]) -> _Array:
        """(6 n, m): slopes of the poses at n places, six rows for each, a column for each of m parameters."""

@final
class Estimate:
    """What fam.estimate gives. Unknowns are in the order of the problem's, in the units of the scene."""

    @property
    def status(self) -> str:
        """'converged', or why not."""
    @property
    def converged(self) -> bool: ...
    @property
    def message(self) -> str:
        """One line: why not converged, or that the model does not fit; else empty."""
    @property
    def names(self) -> list[str]:
        """'loads[0].x, N', 'sections[1].bending_factor', ..."""
    @property
    def mean(self) -> _Array:
        """(n,): NaN where an unknown cannot be observed."""
    @property
    def sd(self) -> _Array:
        """(n,): standard deviations, likewise."""
    @property
    def observable(self) -> list[bool]: ...
    @property
    def covariance(self) -> _Array:
        """(n, n)."""
    @property
    def unobservable(self) -> _Array:
        """(m, n): directions of the unknowns of which the measurements tell nothing, in units of their own."""
    @property
    def chi_squared(self) -> float: ...
    @property
    def degrees_of_freedom(self) -> int: ...
    @property
    def fits(self) -> bool:
        """chi_squared is below what one in 1000 exceeds."""
    @property
    def iterations(self) -> int: ...

@final
class Estimator:
    """Loads, places, stiffness factors and rest curvatures from what was measured of a rod's shape, kept for a stream.

    The next estimate starts from the last one. One estimator only in one thread at a time; others run while it searches.
    """

    def __init__(
        self,
        problem: _Scene,
        tolerance_mm: float | None = None,
        arcs: int | None = None,
        law: _Law = "auto",
        model: _Model = "auto",
    ) -> None:
        """problem: a dict in the estimation format, its JSON text, or the path of a file."""
    def set_measurement(self, measurement: int, value: ArrayLike, scene: int = 0) -> None:
        """New numbers for one of the problem's measurements, whose kind, place and deviation stay.

        (3,) mm of a position, (3, 3) of a rotation, (2,) 1/mm of a curvature, (6,) N and N mm of a base wrench.
        """
    def estimate(self) -> Estimate: ...

def estimate(
    problem: _Scene,
    tolerance_mm: float | None = None,
    arcs: int | None = None,
    law: _Law = "auto",
    model: _Model = "auto",
) -> Estimate:
    """As `fam estimate`: the unknowns of a problem, and how well they are known."""
