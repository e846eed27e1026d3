#include "fam/march.h"

#include <algorithm>
#include <cassert>

namespace fam {
namespace {

SectionWrench to_section(const scene::Wrench& wrench) {
  return {wrench.force_N, wrench.moment_Nmm};
}

// The whole of an arc as one motion for the wrench and the pose at its ends.
struct ArcMotion {
  RigidMotion before, screw, after;

  explicit ArcMotion(const Arc& arc)
      : before(twist(arc.twist_before_rad)), screw(exponential(arc.screw)), after(twist(arc.twist_after_rad)) {}

  SectionWrench carry(const SectionWrench& distal) const {
    return transport(before, transport(screw, transport(after, distal)));
  }
};

}  // namespace

March::March(std::span<const scene::Span> spans, std::span<const int> arcs_per_span, Law law, RodModel model,
             TwistOrder twist_order)
    : law_(law), model_(model), twist_order_(twist_order) {
  assert(spans.size() == arcs_per_span.size() && law != Law::automatic && model != RodModel::automatic);
  int first_arc = 0;
  spans_.reserve(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans_.push_back({arc_constants(spans[i], arcs_per_span[i], model), first_arc, arcs_per_span[i],
                      to_section(spans[i].follower_load_S), to_section(spans[i].tendon_S)});
    first_arc += arcs_per_span[i];
  }
  arcs_.resize(static_cast<std::size_t>(first_arc));
  poses_.resize(arcs_.size() + 1);
}

// Tip to clamp: strain_of(constants, distal wrench, arc) sets the arc and the wrench at its proximal end.
template <class Strain>
void March::march(Strain&& strain_of) {
  SectionWrench wrench;
  for (auto span = spans_.rbegin(); span != spans_.rend(); ++span) {
    wrench.force_N += span->load_S.force_N;
    wrench.moment_Nmm += span->load_S.moment_Nmm;
    Arc* const first = arcs_.data() + span->first_arc;
    for (Arc* arc = first + span->arc_count; arc-- != first;) strain_of(span->constants, wrench, *arc);
  }
  base_wrench_ = {wrench.force_N + spans_.front().tendon_S.force_N,
                  wrench.moment_Nmm + spans_.front().tendon_S.moment_Nmm};
}

template <bool with_shear>
FAM_FLATTEN bool March::run_law() {
  if (law_ == Law::midpoint) {
    march([](const ArcConstants& constants, SectionWrench& wrench, Arc& arc) {
      midpoint_step<with_shear>(constants, wrench, arc.screw);
    });
  } else {
    march([](const ArcConstants& constants, SectionWrench& wrench, Arc& arc) {
      fourth_order_step<with_shear>(constants, wrench, arc.screw);
    });
  }
  return true;
}

bool March::run_published() {
  march([this](const ArcConstants& constants, SectionWrench& wrench, Arc& arc) {
    if (!published_arc(constants, wrench, twist_order_, arc) && failed_arc_ < 0) {
      failed_arc_ = static_cast<int>(&arc - arcs_.data());
    }
    wrench = ArcMotion(arc).carry(wrench);
  });
  return failed_arc_ < 0;
}

// Clamp to tip: composes the poses of the arc ends.
FAM_FLATTEN void March::place_arcs() {
  poses_.front() = SectionPose{};
  for (std::size_t k = 0; k < arcs_.size(); ++k) {
    if (law_ == Law::published) {
      const ArcMotion motion(arcs_[k]);
      poses_[k + 1] = poses_[k].then(motion.before).then(motion.screw).then(motion.after);
    } else {
      poses_[k + 1] = poses_[k].then(exponential(arcs_[k].screw));
    }
  }
}

scene::Status March::run() noexcept {
  failed_arc_ = -1;
  const bool found = law_ == Law::published         ? run_published()
                     : model_ == RodModel::reissner ? run_law<true>()
                                                    : run_law<false>();
  if (!found) return scene::Status::arc_not_converged;
  place_arcs();
  const SectionPose& tip = poses_.back();
  const bool finite = tip.position_B_mm.allFinite() && tip.rotation_BS.allFinite() &&
                      base_wrench_.force_N.allFinite() && base_wrench_.moment_Nmm.allFinite();
  return finite ? scene::Status::converged : scene::Status::not_finite;
}

}  // namespace fam
