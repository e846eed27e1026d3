#include "fam/march.h"

#include <cassert>

namespace fam {
namespace {

// The whole of a published arc as motions for the wrench and the pose at its ends.
struct ArcMotion {
  RigidMotion before, screw, after;

  explicit ArcMotion(const Arc& arc)
      : before(twist(arc.twist_before_rad)), screw(exponential(arc.screw)), after(twist(arc.twist_after_rad)) {}

  SectionWrench carry(const SectionWrench& distal) const {
    return transport(before, transport(screw, transport(after, distal)));
  }
};

}  // namespace

template <int D>
void BasicMarch<D>::set(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law, RodModel model,
                        TwistOrder twist_order) {
  law_ = law;
  model_ = model;
  twist_order_ = twist_order;
  assert(spans.size() == arcs_per_span.size() && chosen(law) == law && model != RodModel::automatic);
  assert(D == 3 || facts_of(law).coupled);
  int first_arc = 0;
  spans_.resize(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans_[i].set({spans[i], spans[i]}, model, first_arc, arcs_per_span[i]);
    first_arc += arcs_per_span[i];
  }
  arcs_.resize(static_cast<std::size_t>(first_arc));
  motions_.resize(arcs_.size());
  poses_.resize(arcs_.size() + 1);
  distal_wrenches_S_.resize(arcs_.size());
}

template <int D>
void BasicMarch<D>::reserve(const Room& room) {
  spans_.reserve(room.spans, [&](SpanArcs<D>& span) { span.reserve(room.tendons); });
  arcs_.reserve(room.arcs);
  motions_.reserve(room.arcs);
  poses_.reserve(room.arcs + 1);
  distal_wrenches_S_.reserve(room.arcs);
}

// Tip to clamp: march_span(span, wrench) marches the arcs of a span and leaves the wrench at its proximal end.
template <int D>
template <class MarchSpan>
void BasicMarch<D>::march(MarchSpan&& march_span) {
  BasicWrench<double, D> wrench;
  for (std::size_t i = spans_.size(); i-- > 0;) {
    wrench = wrench + spans_[i].follower_load_S;
    march_span(spans_[i], wrench);
  }
  base_wrench_ = wrench;
}

// Calls step(arc, wrench) for each arc of a span, tip to clamp.
template <class Wrench, class Span, class Step>
void for_arcs(const Span& span, Wrench& wrench, std::vector<Wrench>& record, Step&& step) {
  for (int k = span.end_arc; k-- > span.first_arc;) {
    const auto arc = static_cast<std::size_t>(k);
    record[arc] = wrench;
    step(arc, wrench);
  }
}

template <int D>
template <class CoupledLaw, bool with_shear>
FAM_FLATTEN void BasicMarch<D>::run_law() {
  march([&](const SpanArcs<D>& span, auto& wrench) {
    const ArcForces<double, D> follower{span.follower_force_S_N, Vector<double, D>::Zero()};
    const ArcForces<double, D>* forces = span.distributed ? &follower : nullptr;
    if (!span.constants.is_elastic()) {
      for_arcs(span, wrench, distal_wrenches_S_, [&](std::size_t arc, auto& w) {
        motions_[arc] = tendon_step<with_shear>(law_, span.constants, forces, w, arcs_[arc].screw, tendon_collapsed_);
      });
      return;
    }
    for_arcs(span, wrench, distal_wrenches_S_, [&](std::size_t arc, auto& w) {
      BasicScrew<double, D>& screw = arcs_[arc].screw;
      if constexpr (D == 3) {
        motions_[arc] = elastic_step<with_shear>(law_, span.constants, forces, w, screw);
      } else {
        motions_[arc] = CoupledLaw::step(ElasticSection<with_shear, double, D>(span.constants), forces, w, screw);
      }
    });
  });
  place_arcs();
}

// Clamp to tip: composes the poses of the arc ends.
template <int D>
void BasicMarch<D>::place_arcs() {
  poses_.front() = {};
  for (std::size_t k = 0; k < arcs_.size(); ++k) poses_[k + 1] = poses_[k].then(motions_[k]);
}

template <int D>
void BasicMarch<D>::run_published() {
  if constexpr (D == 3) {
    march([this](const SpanArcs<D>& span, SectionWrench& wrench) {
      for_arcs(span, wrench, distal_wrenches_S_, [&](std::size_t k, SectionWrench& w) {
        if (!published_arc(span.constants, w, twist_order_, arcs_[k]) && failed_arc_ < 0)
          failed_arc_ = static_cast<int>(k);
        const ArcMotion motion(arcs_[k]);
        w = motion.carry(w);
        motions_[k] = motion.screw;
      });
    });
    poses_.front() = {};
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      poses_[k + 1] =
          poses_[k].then(twist(arcs_[k].twist_before_rad)).then(motions_[k]).then(twist(arcs_[k].twist_after_rad));
    }
  }
}

template <int D>
scene::Status BasicMarch<D>::run() noexcept {
  failed_arc_ = -1;
  tendon_collapsed_ = false;
  visit_law(law_, [&](auto law) {
    if constexpr (!law.facts.coupled) run_published();
    else if (model_ == RodModel::reissner) run_law<decltype(law), true>();
    else run_law<decltype(law), false>();
  });
  if (failed_arc_ >= 0) return scene::Status::arc_not_converged;
  const BasicPose<D>& tip = poses_.back();
  const bool finite = tip.position_B_mm.allFinite() && tip.rotation_BS.allFinite() &&
                      base_wrench_.force_N.allFinite() && base_wrench_.moment_Nmm.allFinite();
  if (tendon_collapsed_) return scene::Status::tendon_collapsed;
  return finite ? scene::Status::converged : scene::Status::not_finite;
}

template class BasicMarch<2>;
template class BasicMarch<3>;

}  // namespace fam
