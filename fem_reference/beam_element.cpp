#include "fem_reference/beam_element.h"

#include "fem_reference/point_terms.h"

#include <array>

namespace fem_reference {

namespace {

using Eigen::Matrix3d;
using Eigen::Matrix4d;
using Eigen::Vector3d;
using Matrix43 = Eigen::Matrix<double, 4, 3>;

// Derivatives by arc length are those by the reference coordinate over the element's length.
struct Interpolated {
  Vector3d r_B = Vector3d::Zero();
  Vector3d dr_B = Vector3d::Zero();  // r'
  Quaternion p = Quaternion::Zero();
  Quaternion dp = Quaternion::Zero();  // p'

  void add(double value, double slope, const Vector3d& position_B, const Quaternion& rotation_BS) {
    r_B += value * position_B;
    dr_B += slope * position_B;
    p += value * rotation_BS;
    dp += slope * rotation_BS;
  }
  SectionStrain strain() const { return {rotated(conjugate(p), dr_B), curvature(p, dp).value}; }
};

Interpolated interpolate(const ReferenceElement& reference, double length, const ElementState& state, int g) {
  Interpolated at;
  for (int i = 0; i < reference.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    at.add(reference.value(g, i), reference.slope(g, i) / length, state.position_B[node], state.rotation_BS[node]);
  }
  return at;
}

// Derivative of q exp(rotation) by the rotation vector at zero.
Matrix43 by_rotation(const Quaternion& q) {
  Matrix43 E;
  E.row(0) = -q.tail<3>().transpose();
  E.bottomRows<3>() = q[0] * Matrix3d::Identity() + skew(q.tail<3>());
  return 0.5 * E;
}

// Where a node's or a point's unknowns start among the element's.
int displacement_of(int node) {
  return 6 * node;
}
int rotation_of(int node) {
  return 6 * node + 3;
}
int force_of(const ReferenceElement& reference, int g) {
  return 6 * reference.nodes() + 3 * g;
}

using NodalMaps = std::array<Matrix43, max_nodes>;         // derivative of each q_i by its rotation vector
using NodalGradients = std::array<Quaternion, max_nodes>;  // derivative of the functional by each q_i

void add_residual(const ReferenceElement& reference, double length, int g, const PointGradient& terms,
                  NodalGradients& by_q, ElementResidual& residual) {
  const double w = reference.weight(g) * length;
  residual.segment<3>(force_of(reference, g)) = w * terms.by_n;
  for (int i = 0; i < reference.nodes(); ++i) {
    const double N = reference.value(g, i), dN = reference.slope(g, i) / length;
    residual.segment<3>(displacement_of(i)) += w * (dN * terms.by_dr - N * terms.load_B);
    by_q[static_cast<std::size_t>(i)] += w * (N * terms.by_p + dN * terms.by_dp);
  }
}

// Second derivatives of the functional, summed over the points, by q_i and q_j and by r_i and q_j.
struct NodalHessians {
  std::array<std::array<Matrix4d, max_nodes>, max_nodes> by_q_q;  // i <= j
  std::array<std::array<Matrix34, max_nodes>, max_nodes> by_r_q;
  std::array<std::array<Matrix34, max_nodes>, max_nodes> load_by_q;  // of the loads at r_i, which have no energy
};

void set_zero(NodalHessians& hessians, std::size_t nodes) {
  for (std::size_t i = 0; i < nodes; ++i) {
    for (std::size_t j = 0; j < nodes; ++j) {
      hessians.by_q_q[i][j].setZero();
      hessians.by_r_q[i][j].setZero();
      hessians.load_by_q[i][j].setZero();
    }
  }
}

void add_hessians(const ReferenceElement& reference, const ElementData& data, int g, const PointHessian& terms,
                  NodalHessians& hessians) {
  const double w = reference.weight(g) * data.length;
  const bool load_turns = !data.follower_force_S.isZero(0);
  for (int j = 0; j < reference.nodes(); ++j) {
    const double Nj = reference.value(g, j), dNj = reference.slope(g, j) / data.length;
    const Matrix4d by_p_q = w * (Nj * terms.by_p_p + dNj * terms.by_p_dp);
    const Matrix4d by_dp_q = w * (Nj * terms.by_p_dp.transpose() + dNj * terms.by_dp_dp);
    const Matrix34 by_dr_q = w * (Nj * terms.by_dr_p + dNj * terms.by_dr_dp);
    for (int i = 0; i < reference.nodes(); ++i) {
      const double Ni = reference.value(g, i), dNi = reference.slope(g, i) / data.length;
      const auto row = static_cast<std::size_t>(i), column = static_cast<std::size_t>(j);
      if (i <= j) hessians.by_q_q[row][column] += Ni * by_p_q + dNi * by_dp_q;
      hessians.by_r_q[row][column] += dNi * by_dr_q;
      if (load_turns) hessians.load_by_q[row][column] += (w * Ni * Nj) * terms.load_by_p;
    }
  }
}

// What a point's internal force and the displacements have to do with each other, and the force with the turns.
void add_point_tangent(const ReferenceElement& reference, const ElementData& data, int g, const PointGradient& terms,
                       const Matrix3d& by_dr_dr, const NodalMaps& E, ElementSystem& system) {
  const double w = reference.weight(g) * data.length;
  const int n = force_of(reference, g);
  auto& K = system.tangent;
  K.block<3, 3>(n, n) = -w * Matrix3d(data.force_compliance.asDiagonal());
  for (int j = 0; j < reference.nodes(); ++j) {
    const double Nj = reference.value(g, j), dNj = reference.slope(g, j) / data.length;
    const int rj = displacement_of(j), tj = rotation_of(j);
    const Matrix3d n_by_t = w * Nj * terms.by_n_p * E[static_cast<std::size_t>(j)];
    K.block<3, 3>(n, rj) = w * dNj * terms.R.transpose();
    K.block<3, 3>(rj, n) = w * dNj * terms.R;
    K.block<3, 3>(n, tj) = n_by_t;
    K.block<3, 3>(tj, n) = n_by_t.transpose();
    for (int i = 0; !data.tendons.empty() && i < reference.nodes(); ++i) {
      K.block<3, 3>(displacement_of(i), rj) += w * reference.slope(g, i) / data.length * dNj * by_dr_dr;
    }
  }
}

void add_nodal_tangent(const NodalHessians& hessians, int nodes, const NodalMaps& E, ElementSystem& system) {
  auto& K = system.tangent;
  for (int j = 0; j < nodes; ++j) {
    const auto column = static_cast<std::size_t>(j);
    const int tj = rotation_of(j);
    for (int i = 0; i < nodes; ++i) {
      const auto row = static_cast<std::size_t>(i);
      const int ri = displacement_of(i), ti = rotation_of(i);
      const Matrix3d r_by_t = hessians.by_r_q[row][column] * E[column];
      K.block<3, 3>(tj, ri) = r_by_t.transpose();
      K.block<3, 3>(ri, tj) = r_by_t - hessians.load_by_q[row][column] * E[column];
      if (i > j) continue;
      const Matrix3d t_by_t = E[row].transpose() * (hessians.by_q_q[row][column] * E[column]);
      K.block<3, 3>(ti, tj) = t_by_t;
      if (i < j) K.block<3, 3>(tj, ti) = t_by_t.transpose();
    }
  }
}

// Residual of the element from its points; `also(g, interpolated, gradient)` is called at each of them.
template <typename Also>
void sum_points(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                double load_factor, ElementResidual& residual, NodalGradients& by_q, const NodalMaps& E,
                const Also& also) {
  residual.setZero(6 * reference.nodes() + 3 * reference.points());
  for (Quaternion& gradient : by_q) gradient.setZero();
  for (int g = 0; g < reference.points(); ++g) {
    const Interpolated at = interpolate(reference, data.length, state, g);
    const PointGradient terms(data, at.dr_B, at.p, at.dp, state.force_S[static_cast<std::size_t>(g)], load_factor);
    add_residual(reference, data.length, g, terms, by_q, residual);
    also(g, at, terms);
  }
  for (int i = 0; i < reference.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    residual.segment<3>(rotation_of(i)) = E[node].transpose() * by_q[node];
  }
}

NodalMaps nodal_maps(const ReferenceElement& reference, const ElementState& state) {
  NodalMaps E;
  for (std::size_t i = 0; i < static_cast<std::size_t>(reference.nodes()); ++i)
    E[i] = by_rotation(state.rotation_BS[i]);
  return E;
}

}  // namespace

ElementState state_of_element(const BeamModel& model, const BeamState& state, std::size_t e) {
  const auto nodes = static_cast<std::size_t>(model.reference.nodes());
  const auto points = static_cast<std::size_t>(model.reference.points());
  const std::size_t first_node = e * (nodes - 1);
  return {{&state.position_B[first_node], nodes},
          {&state.rotation_BS[first_node], nodes},
          {&state.force_S[e * points], points}};
}

void element_residual(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                      double load_factor, ElementResidual& residual) {
  NodalGradients by_q;
  const NodalMaps E = nodal_maps(reference, state);
  sum_points(reference, data, state, load_factor, residual, by_q, E, [](int, const Interpolated&, const auto&) {});
}

void element_system(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                    double load_factor, ElementSystem& system) {
  const int size = 6 * reference.nodes() + 3 * reference.points();
  system.tangent.setZero(size, size);
  NodalGradients by_q;
  NodalHessians hessians;
  set_zero(hessians, static_cast<std::size_t>(reference.nodes()));
  const NodalMaps E = nodal_maps(reference, state);
  const auto add_tangent = [&](int g, const Interpolated& at, const PointGradient& gradient) {
    const PointHessian hessian(data, at.dr_B, at.p, at.dp, gradient, load_factor);
    add_point_tangent(reference, data, g, gradient, hessian.by_dr_dr, E, system);
    add_hessians(reference, data, g, hessian, hessians);
  };
  sum_points(reference, data, state, load_factor, system.residual, by_q, E, add_tangent);
  add_nodal_tangent(hessians, reference.nodes(), E, system);
  for (int i = 0; i < reference.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    const int t = rotation_of(i);
    const Vector3d moment_S = system.residual.segment<3>(t);
    // The map E_i turns with its own node: d(E_i^T g) = E_i^T dg + (dE_i)^T g.
    system.tangent.block<3, 3>(t, t) +=
        0.5 * skew(moment_S) - 0.25 * state.rotation_BS[node].dot(by_q[node]) * Matrix3d::Identity();
  }
}

SectionStrain element_strain(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                             int g) {
  return interpolate(reference, data.length, state, g).strain();
}

SectionState section_at(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                        double x) {
  const ReferenceElement::Shape shape = reference.shape(x);
  Interpolated at;
  for (int i = 0; i < reference.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    at.add(shape.value(i), shape.slope(i) / data.length, state.position_B[node], state.rotation_BS[node]);
  }
  return {at.r_B, rotation_matrix(at.p), at.strain()};
}

EndWrenches end_wrenches(const ReferenceElement& reference, const ElementState& state,
                         const ElementResidual& residual) {
  const int last = reference.order();
  return {residual.segment<3>(displacement_of(0)),
          rotated(state.rotation_BS.front(), residual.segment<3>(rotation_of(0))),
          residual.segment<3>(displacement_of(last)),
          rotated(state.rotation_BS.back(), residual.segment<3>(rotation_of(last)))};
}

NodalSystem nodal_system(const NodalLoad& load, const Quaternion& rotation_BS, double load_factor) {
  const Matrix3d R = rotation_matrix(rotation_BS);
  const Vector3d fixed_moment_S = R.transpose() * load.fixed_B.moment_Nmm;
  const Matrix3d arms_S = R.transpose() * load.fixed_force_arms_BS;  // sum f r^T, f = R^T F
  const Vector3d moment_S = fixed_moment_S + load.follower_S.moment_Nmm + scene::moment_of_arms<double>(arms_S);
  NodalSystem system;
  system.residual.head<3>() = -load_factor * (load.fixed_B.force_N + R * load.follower_S.force_N);
  system.residual.tail<3>() = -load_factor * moment_S;
  // d(R f) = -R [f]x d(rotation) and d(R^T m) = [R^T m]x d(rotation); a follower moment does not change;
  // d(r x R^T F) = [r]x [f]x d(rotation) = (f r^T - (f . r) I) d(rotation).
  system.tangent.setZero();
  system.tangent.block<3, 3>(0, 3) = load_factor * R * skew(load.follower_S.force_N);
  system.tangent.block<3, 3>(3, 3) =
      -load_factor * (skew(fixed_moment_S) + arms_S - arms_S.trace() * Matrix3d::Identity());
  return system;
}

}  // namespace fem_reference
