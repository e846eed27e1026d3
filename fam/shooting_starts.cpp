// What Newton's method starts from where the loads alone tell: the rest shape, or the march from the clamp.
#include "fam/shooting.h"

namespace fam {
namespace {

// The arc from its proximal end to its distal one.
template <int D>
BasicArcConstants<D> backwards(BasicArcConstants<D> arc) {
  arc.length_mm *= -1;
  arc.angular_compliance *= -1;
  arc.rest_rotation *= -1;
  arc.linear_compliance *= -1;
  arc.rest_translation_mm *= -1;
  return arc;
}

template <int D>
BasicWrench<double, D> loads_at_end(const SpanArcs<D>& span, const Eigen::Matrix<double, D, D>& rotation_SB) {
  BasicWrench<double, D> loads;
  span.add_point_loads(rotation_SB, loads);
  return loads;
}

}  // namespace

// March without load from a tip turned so that the clamp has R = I.
template <int D>
void Shooting<D>::start_unloaded() {
  set_load(0);
  Node tip{Rotation::Identity(), {}};
  Node clamp = tip;
  rod_.march({0, rod_.arc_count()}, clamp);
  tip.rotation_SB = clamp.rotation_SB.transpose();
  for (std::size_t k = segments_.size(); k-- > 0;) {
    nodes_[k] = tip;
    if (k > 0) rod_.march(segments_[k], tip);
  }
}

template <int D>
bool Shooting<D>::start_from_clamp() {
  set_load(1);
  Node at{Rotation::Identity(), {}};
  for (const SpanArcs<D>& span : rod_.span_arcs()) span.add_point_loads(at.rotation_SB, at.wrench);
  std::size_t segment = 0;
  for (const SpanArcs<D>& span : rod_.span_arcs()) {
    const BasicArcConstants<D> back = backwards(span.constants);
    const ElasticSection<false, double, D> section(back);
    for (int arc = span.first_arc; arc < span.end_arc; ++arc) {
      BasicScrew<double, D> screw;
      const BasicMotion<double, D> motion =
          flat_step(rod_.law(), section, static_cast<const ArcForces<double, D>*>(nullptr), at.wrench, screw);
      for (int axis = 0; axis < D; ++axis)
        at.rotation_SB.col(axis) = motion.rotate(Vector<double, D>(at.rotation_SB.col(axis)));
      if (arc + 1 == span.end_arc) at.wrench.moment_Nmm -= loads_at_end(span, at.rotation_SB).moment_Nmm;
      if (arc + 1 == segments_[segment].end_arc) nodes_[segment++] = at;
    }
  }
  nodes_.back().wrench = {};
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    if (!equations(k, false).mismatch_is_small) return false;
  }
  return true;
}

template void Shooting<2>::start_unloaded();
template void Shooting<3>::start_unloaded();
template bool Shooting<2>::start_from_clamp();
template bool Shooting<3>::start_from_clamp();

}  // namespace fam
