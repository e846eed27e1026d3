#include "fem_reference/beam_element.h"

#include "fem_reference/section_strain.h"
#include "fem_reference/tendon_pull.h"

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

// Gradient and Hessian of the integrand by r', p, p' and n at one Gauss point, and the external force per length.
struct PointTerms {
  Matrix3d R;
  Vector3d by_dr;  // the total force in the base frame
  Vector3d by_n;   // v - e_x - C n
  Quaternion by_p, by_dp;
  Matrix3d by_dr_dr;  // second derivatives, rows by the first, columns by the second name
  Matrix34 by_dr_p, by_dr_dp;
  Matrix34 by_n_p;
  Matrix4d by_p_p, by_p_dp, by_dp_dp;
  Vector3d load_B;
  Matrix34 load_by_p;
};

PointTerms point_terms(const ElementData& data, const Interpolated& at, const Vector3d& n, double load_factor) {
  PointTerms terms;
  terms.R = rotation_matrix(at.p);
  const Vector3d v = terms.R.transpose() * at.dr_B;
  const Curvature u = curvature(at.p, at.dp);
  const TendonPull pull = tendon_pull(data, {v, u.value}, load_factor);
  const Vector3d n_total = n + pull.force_S;
  const Vector3d m_total = data.moment_stiffness.cwiseProduct(u.value - data.rest_curvature) + pull.moment_S;
  terms.by_dr = terms.R * n_total;
  terms.by_n = v - Vector3d::UnitX() - data.force_compliance.cwiseProduct(n);
  terms.by_n_p = rotated_back_by_p(at.p, at.dr_B);
  terms.by_p = terms.by_n_p.transpose() * n_total + u.by_p.transpose() * m_total;
  terms.by_dp = u.by_dp.transpose() * m_total;

  // The change of the total force and moment by p and p' in the section, then that of the section's frame.
  const Matrix3d K = Matrix3d(data.moment_stiffness.asDiagonal()) + pull.by_u_u;
  const Matrix34 n_by_p = pull.by_v_v * terms.by_n_p + pull.by_v_u * u.by_p, n_by_dp = pull.by_v_u * u.by_dp;
  const Matrix34 m_by_p = pull.by_v_u.transpose() * terms.by_n_p + K * u.by_p, m_by_dp = K * u.by_dp;
  const CurvaturePower power = curvature_power(at.p, at.dp, m_total);
  terms.by_dr_dr = terms.R * pull.by_v_v * terms.R.transpose();
  terms.by_dr_p = rotated_by_p(at.p, n_total) + terms.R * n_by_p;
  terms.by_dr_dp = terms.R * n_by_dp;
  terms.by_p_p = power_by_p_p(at.p, at.dr_B, n_total) + power.by_p_p + terms.by_n_p.transpose() * n_by_p +
                 u.by_p.transpose() * m_by_p;
  terms.by_p_dp = power.by_p_dp + terms.by_n_p.transpose() * n_by_dp + u.by_p.transpose() * m_by_dp;
  terms.by_dp_dp = u.by_dp.transpose() * m_by_dp;

  terms.load_B = load_factor * (data.fixed_force_B + terms.R * data.follower_force_S);
  terms.load_by_p = load_factor * rotated_by_p(at.p, data.follower_force_S);
  return terms;
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

void add_residual(const ReferenceElement& reference, double length, int g, const PointTerms& terms,
                  NodalGradients& by_q, ElementSystem& system) {
  const double w = reference.weight(g) * length;
  system.residual.segment<3>(force_of(reference, g)) += w * terms.by_n;
  for (int i = 0; i < reference.nodes(); ++i) {
    const double N = reference.value(g, i), dN = reference.slope(g, i) / length;
    system.residual.segment<3>(displacement_of(i)) += w * (dN * terms.by_dr - N * terms.load_B);
    by_q[static_cast<std::size_t>(i)] += w * (N * terms.by_p + dN * terms.by_dp);
  }
}

void add_tangent(const ReferenceElement& reference, double length, int g, const PointTerms& terms,
                 const Vector3d& force_compliance, const NodalMaps& E, ElementSystem& system) {
  const double w = reference.weight(g) * length;
  const int n = force_of(reference, g);
  auto& K = system.tangent;
  K.block<3, 3>(n, n) -= w * Matrix3d(force_compliance.asDiagonal());
  for (int j = 0; j < reference.nodes(); ++j) {
    const double Nj = reference.value(g, j), dNj = reference.slope(g, j) / length;
    const int rj = displacement_of(j), tj = rotation_of(j);
    const Matrix43& Ej = E[static_cast<std::size_t>(j)];
    const Matrix3d n_by_t = w * Nj * terms.by_n_p * Ej;
    K.block<3, 3>(n, rj) += w * dNj * terms.R.transpose();
    K.block<3, 3>(rj, n) += w * dNj * terms.R;
    K.block<3, 3>(n, tj) += n_by_t;
    K.block<3, 3>(tj, n) += n_by_t.transpose();
    const Matrix43 by_p_t = (Nj * terms.by_p_p + dNj * terms.by_p_dp) * Ej;
    const Matrix43 by_dp_t = (Nj * terms.by_p_dp.transpose() + dNj * terms.by_dp_dp) * Ej;
    const Matrix3d by_dr_t = (Nj * terms.by_dr_p + dNj * terms.by_dr_dp) * Ej;
    const Matrix3d load_by_t = Nj * terms.load_by_p * Ej;
    for (int i = 0; i < reference.nodes(); ++i) {
      const double Ni = reference.value(g, i), dNi = reference.slope(g, i) / length;
      const int ri = displacement_of(i), ti = rotation_of(i);
      const Matrix3d r_by_t = w * dNi * by_dr_t;
      K.block<3, 3>(ti, tj) += w * E[static_cast<std::size_t>(i)].transpose() * (Ni * by_p_t + dNi * by_dp_t);
      K.block<3, 3>(ri, rj) += w * dNi * dNj * terms.by_dr_dr;
      K.block<3, 3>(ri, tj) += r_by_t - w * Ni * load_by_t;
      K.block<3, 3>(tj, ri) += r_by_t.transpose();
    }
  }
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

void element_system(const ReferenceElement& reference, const ElementData& data, const ElementState& state,
                    double load_factor, ElementSystem& system) {
  const int size = 6 * reference.nodes() + 3 * reference.points();
  system.residual.setZero(size);
  system.tangent.setZero(size, size);
  NodalMaps E;
  NodalGradients by_q;
  for (int i = 0; i < reference.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    E[node] = by_rotation(state.rotation_BS[node]);
    by_q[node].setZero();
  }
  for (int g = 0; g < reference.points(); ++g) {
    const Interpolated at = interpolate(reference, data.length, state, g);
    const PointTerms terms = point_terms(data, at, state.force_S[static_cast<std::size_t>(g)], load_factor);
    add_residual(reference, data.length, g, terms, by_q, system);
    add_tangent(reference, data.length, g, terms, data.force_compliance, E, system);
  }
  for (int i = 0; i < reference.nodes(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    const int t = rotation_of(i);
    const Vector3d moment_S = E[node].transpose() * by_q[node];
    system.residual.segment<3>(t) = moment_S;
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

EndWrenches end_wrenches(const ReferenceElement& reference, const ElementState& state, const ElementSystem& system) {
  const int last = reference.order();
  return {system.residual.segment<3>(displacement_of(0)),
          rotated(state.rotation_BS.front(), system.residual.segment<3>(rotation_of(0))),
          system.residual.segment<3>(displacement_of(last)),
          rotated(state.rotation_BS.back(), system.residual.segment<3>(rotation_of(last)))};
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
