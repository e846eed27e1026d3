// A rod at a share of its loads, and the march over its arcs from the tip towards the clamp, with what varies with the
// sections' rotations and wrenches.
#pragma once

#include "fam/arc_law.h"
#include "fam/dual.h"
#include "fam/span_arcs.h"
#include "fam/vector_unit.h"

#include <algorithm>
#include <span>
#include <vector>

namespace fam {

// Base axes in the section frame, and the wrench there.
template <int D, class T = double>
struct SectionState {
  Eigen::Matrix<T, D, D> rotation_SB;
  BasicWrench<T, D> wrench;
};

// Arcs first_arc .. end_arc - 1, the last of them marched first.
struct ArcRange {
  int first_arc, end_arc;
};

// The loads of a rod on the straight line from those that it had to those that it gets: spans with the same cuts.
// `bounds` holds of each load the larger, for what loads can do on the way at most.
struct LoadWay {
  std::span<const scene::Span> from, to, bounds;

  SpanOnWay span(std::size_t i, double share) const { return {from[i], to[i], share}; }
};

// Spans whose loads grow from none.
class GrowingLoads {
 public:
  explicit GrowingLoads(std::span<const scene::Span> spans) : to_(spans.begin(), spans.end()), from_(to_) {
    for (scene::Span& span : from_) span.unload();
  }
  LoadWay way() const { return {from_, to_, to_}; }

 private:
  std::vector<scene::Span> to_, from_;
};

// What memory is taken for beforehand.
struct Room {
  std::size_t arcs, spans, tendons;
};
// Of a span.
std::size_t most_tendons(std::span<const scene::Span> spans);

// In space, D = 3, or for rods in the x-y plane, D = 2 (spans with nothing out of it).
template <int D>
class LoadedRod {
 public:
  void reserve(const Room& room);
  // Any coupled law; every kind of load. The spans must stay where they are.
  void set(const LoadWay& way, std::span<const int> arcs_per_span, Law law, RodModel model);

  // The share of the way from the loads that the rod had to those that it gets.
  void set_load(double factor);

  double load_factor() const { return load_factor_; }
  const LoadWay& way() const { return way_; }
  std::span<const SpanArcs<D>> span_arcs() const { return span_arcs_; }
  std::span<const int> arcs_per_span() const { return arcs_per_span_; }
  int arc_count() const { return span_arcs_.back().end_arc; }
  Law law() const { return law_; }
  RodModel model() const { return model_; }

  // Marches over the arcs, last to first. after_arc(index, screw, motion, state) sees each proximal end, and its member
  // meet(index, state), if it has one, each distal end.
  template <class T, class After>
  void march(ArcRange arcs, SectionState<D, T>& state, After&& after_arc) const {
    if (model_ == RodModel::reissner) march_with<true>(arcs, state, after_arc);
    else march_with<false>(arcs, state, after_arc);
  }
  template <class T>
  void march(ArcRange arcs, SectionState<D, T>& state) const {
    march(arcs, state, [](int, const auto&, const auto&, const auto&) {});
  }

  // visit(span, first arc, end arc): the part of each span that lies in the range, the last span first.
  template <class Visit>
  void for_spans(ArcRange arcs, Visit&& visit) const {
    const SpanArcs<D>* span = std::upper_bound(span_arcs_.begin(), span_arcs_.end(), arcs.end_arc - 1,
                                               [](int arc, const SpanArcs<D>& s) { return arc < s.first_arc; });
    for (int end_arc = arcs.end_arc; end_arc > arcs.first_arc; end_arc = span->first_arc) {
      --span;
      visit(*span, std::max(arcs.first_arc, span->first_arc), end_arc);
    }
  }

  // A tendon had no length somewhere in a march since forget_collapse().
  bool tendon_collapsed() const { return tendon_collapsed_; }
  void note_collapse() const { tendon_collapsed_ = true; }
  void forget_collapse() { tendon_collapsed_ = false; }

 private:
  template <bool with_shear, class T, class After>
  void march_with(ArcRange arcs, SectionState<D, T>& state, After&& after_arc) const;

  LoadWay way_;
  std::vector<int> arcs_per_span_;
  Law law_ = AutomaticLaw::facts.law;
  RodModel model_ = RodModel::kirchhoff;
  scene::Reused<SpanArcs<D>> span_arcs_;
  double load_factor_ = 1;
  mutable bool tendon_collapsed_ = false;
};

// The step of a law with every call inlined: twice as fast. Not to be inlined itself: into a caller that is not
// flattened it would lose its calls' inlining.
template <class Section, class T, int D>
FAM_FLATTEN [[gnu::noinline]] BasicMotion<T, D> flat_step(Law law, const Section& section,
                                                          const ArcForces<T, D>* distributed, BasicWrench<T, D>& wrench,
                                                          BasicScrew<T, D>& screw) {
  return law_step(law, section, distributed, wrench, screw);
}

template <int D>
template <bool with_shear, class T, class After>
void LoadedRod<D>::march_with(ArcRange arcs, SectionState<D, T>& state, After&& after_arc) const {
  for_spans(arcs, [&](const SpanArcs<D>& span, int first_arc, int end_arc) {
    if (end_arc == span.end_arc) span.add_point_loads(state.rotation_SB, state.wrench);
    const ElasticSection<with_shear, T, D> section(span.constants);
    for (int arc = end_arc; arc-- > first_arc;) {
      BasicScrew<T, D> screw;
      BasicMotion<T, D> motion;
      ArcForces<T, D> forces;
      if (span.distributed) forces = span.forces(state.rotation_SB);
      const ArcForces<T, D>* distributed = span.distributed ? &forces : nullptr;
      if constexpr (requires { after_arc.meet(arc, state); }) after_arc.meet(arc, state);
      if (!span.constants.is_elastic()) {
        motion = tendon_step<with_shear>(law_, span.constants, distributed, state.wrench, screw, tendon_collapsed_);
      } else if constexpr (D == 3 && std::is_same_v<T, double>) {
        motion = elastic_step<with_shear>(law_, span.constants, distributed, state.wrench, screw);
      } else if constexpr (sizeof(T) <= sizeof(Dual<1>)) {
        motion = flat_step(law_, section, distributed, state.wrench, screw);
      } else {
        call_on(widest_unit(), [&] { motion = law_step(law_, section, distributed, state.wrench, screw); });
      }
      for (int axis = 0; axis < D; ++axis) {
        state.rotation_SB.col(axis) = motion.rotate(Vector<T, D>(state.rotation_SB.col(axis)));
      }
      after_arc(arc, screw, motion, state);
    }
  });
}

}  // namespace fam
