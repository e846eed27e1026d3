#include "fam/boundary_value.h"

#include <cmath>

namespace fam {

template <int D>
void BasicBoundaryValue<D>::set(const LoadWay& way, std::span<const int> arcs_per_span, Law law, RodModel model,
                                double newton_tolerance, const BasicBoundaryValue* fewer) {
  shooting_.set(way, arcs_per_span, law, model, newton_tolerance, fewer ? &fewer->shooting_ : nullptr);
  growth_.set(shooting_);
  poses_.resize(static_cast<std::size_t>(arc_count()) + 1);
}

template <int D>
void BasicBoundaryValue<D>::reserve(const Room& room) {
  shooting_.reserve(room);
  growth_.reserve(room);
  poses_.reserve(room.arcs + 1);
}

template <int D>
bool BasicBoundaryValue<D>::loads_overflow() {
  const LoadBounds& bounds = shooting_.bounds();
  const bool overflow = !std::isfinite(bounds.load_length + bounds.turn_rad + bounds.strain);
  why_ = overflow ? "the squares of the loads overflow" : nullptr;
  return overflow;
}

template <int D>
scene::Status BasicBoundaryValue<D>::run(double swing_limit_rad) {
  if (loads_overflow()) return scene::Status::not_finite;
  shooting_.forget_work();
  const scene::Status status = growth_.run(shooting_, swing_limit_rad);
  return status == scene::Status::converged ? place_arcs() : status;
}

template <int D>
scene::Status BasicBoundaryValue<D>::run_at_once() {
  if (loads_overflow()) return scene::Status::not_finite;
  shooting_.forget_work();
  return growth_.run_at_once(shooting_) ? place_arcs() : scene::Status::not_converged;
}

template <int D>
scene::Status BasicBoundaryValue<D>::run_from(const BasicBoundaryValue& fewer_arcs) {
  why_ = nullptr;
  const bool solved = shooting_.solve_from(fewer_arcs.shooting_);
  growth_.take_over(fewer_arcs.growth_, shooting_.determinant());
  if (solved) return place_arcs();
  why_ = "Newton did not converge from the solution with fewer arcs";
  return scene::Status::not_converged;
}

template <int D>
scene::Status BasicBoundaryValue<D>::go_on_from(const BasicBoundaryValue& fewer_arcs) {
  why_ = nullptr;
  if (!shooting_.solve_from(fewer_arcs.shooting_)) return scene::Status::not_converged;
  const scene::Status status = growth_.go_on(shooting_, fewer_arcs.growth_);
  return status == scene::Status::converged ? place_arcs() : status;
}

// Arcs, poses and wrenches from the nodes.
template <int D>
scene::Status BasicBoundaryValue<D>::place_arcs() {
  stability_.reset();
  shooting_.march_all();
  const MarchedArcs<D>& marched = shooting_.marched();
  poses_.front() = {};
  for (std::size_t k = 0; k < marched.motions.size(); ++k) poses_[k + 1] = poses_[k].then(marched.motions[k]);
  if (poses_.back().position_B_mm.allFinite() && marched.clamp_moment_Nmm.allFinite()) return scene::Status::converged;
  why_ = "a pose or wrench is not finite";
  return scene::Status::not_finite;
}

template class BasicBoundaryValue<2>;
template class BasicBoundaryValue<3>;

}  // namespace fam
