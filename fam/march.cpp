#include "fam/march.h"

#include <cassert>

namespace fam {
namespace {

template <int D>
BasicWrench<double, D> to_section(const scene::Wrench& wrench) {
  return {in_space_or_plane<D>(wrench.force_N), turn_in_space_or_plane<D>(wrench.moment_Nmm)};
}

template <int D>
constexpr const ArcForces<double, D>* no_forces = nullptr;

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
BasicMarch<D>::BasicMarch(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law,
                          RodModel model, TwistOrder twist_order)
    : law_(law), model_(model), twist_order_(twist_order) {
  assert(spans.size() == arcs_per_span.size() && law != Law::automatic && model != RodModel::automatic);
  assert(D == 3 || law != Law::published);
  int first_arc = 0;
  spans_.reserve(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans_.push_back({arc_constants<D>(spans[i], arcs_per_span[i], model), first_arc, arcs_per_span[i],
                      to_section<D>(spans[i].follower_load_S), to_section<D>(spans[i].tendon_S)});
    first_arc += arcs_per_span[i];
  }
  arcs_.resize(static_cast<std::size_t>(first_arc));
  motions_.resize(arcs_.size());
  poses_.resize(arcs_.size() + 1);
}

// Tip to clamp: step(constants, wrench, arc) sets the arc and the wrench at its proximal end and returns its motion.
template <int D>
template <class Step>
void BasicMarch<D>::march(Step&& step) {
  BasicWrench<double, D> wrench;
  for (auto span = spans_.rbegin(); span != spans_.rend(); ++span) {
    wrench = wrench + span->load_S;
    for (int k = span->first_arc + span->arc_count; k-- > span->first_arc;) {
      const auto arc = static_cast<std::size_t>(k);
      motions_[arc] = step(span->constants, wrench, arcs_[arc]);
    }
  }
  base_wrench_ = wrench + spans_.front().tendon_S;
}

template <int D>
template <bool with_shear>
FAM_FLATTEN void BasicMarch<D>::run_law() {
  if (law_ == Law::midpoint) {
    march([](const auto& constants, auto& wrench, auto& arc) {
      return midpoint_step<with_shear>(constants, no_forces<D>, wrench, arc.screw);
    });
  } else if (law_ == Law::fourth_order) {
    march([](const auto& constants, auto& wrench, auto& arc) {
      return fourth_order_step<with_shear>(constants, no_forces<D>, wrench, arc.screw);
    });
  } else {
    march([](const auto& constants, auto& wrench, auto& arc) {
      return sixth_order_step<with_shear>(constants, no_forces<D>, wrench, arc.screw);
    });
  }
  place_arcs();
}

// Clamp to tip: composes the poses of the arc ends.
template <int D>
void BasicMarch<D>::place_arcs() {
  poses_.front() = {};
  for (std::size_t k = 0; k < arcs_.size(); ++k) poses_[k + 1] = poses_[k].then(motions_[k]);
}

template <int D>
bool BasicMarch<D>::run_published() {
  if constexpr (D == 3) {
    march([this](const ArcConstants& constants, SectionWrench& wrench, Arc& arc) {
      if (!published_arc(constants, wrench, twist_order_, arc) && failed_arc_ < 0) {
        failed_arc_ = static_cast<int>(&arc - arcs_.data());
      }
      const ArcMotion motion(arc);
      wrench = motion.carry(wrench);
      return motion.screw;
    });
    poses_.front() = {};
    for (std::size_t k = 0; k < arcs_.size(); ++k) {
      poses_[k + 1] =
          poses_[k].then(twist(arcs_[k].twist_before_rad)).then(motions_[k]).then(twist(arcs_[k].twist_after_rad));
    }
  }
  return failed_arc_ < 0;
}

template <int D>
scene::Status BasicMarch<D>::run() noexcept {
  failed_arc_ = -1;
  if (law_ == Law::published) {
    if (!run_published()) return scene::Status::arc_not_converged;
  } else if (model_ == RodModel::reissner) {
    run_law<true>();
  } else {
    run_law<false>();
  }
  const BasicPose<D>& tip = poses_.back();
  const bool finite = tip.position_B_mm.allFinite() && tip.rotation_BS.allFinite() &&
                      base_wrench_.force_N.allFinite() && base_wrench_.moment_Nmm.allFinite();
  return finite ? scene::Status::converged : scene::Status::not_finite;
}

template class BasicMarch<2>;
template class BasicMarch<3>;

}  // namespace fam
