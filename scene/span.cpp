#include "scene/span.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scene {
namespace {

// Where a load begins or ends.
struct CutFinder {
  std::vector<double> places;

  void operator()(const Force& force) { places.push_back(force.at_mm); }
  void operator()(const Moment& moment) { places.push_back(moment.at_mm); }
  void operator()(const DistributedForce& force) { places.insert(places.end(), {force.from_mm, force.to_mm}); }
  void operator()(const Gravity&) {}
  void operator()(const Tendon& tendon) { places.push_back(tendon.to_mm); }
};

// Sorted places at which spans end, the clamp first. Section ends are kept exactly; other places closer than
// same_place_relative * L to a kept one are that one, and shorter sections vanish.
std::vector<double> cuts_of(const Scene& scene, double length) {
  const double same_place = same_place_relative * length;
  std::vector<double> section_ends{0};
  double end = 0;
  for (const Section& section : scene.sections) {
    end += section.length_mm;
    if (end - section_ends.back() > same_place) section_ends.push_back(end);
  }

  CutFinder finder;
  for (const Load& load : scene.loads) std::visit(finder, load);
  std::vector<double>& places = finder.places;
  std::sort(places.begin(), places.end());

  std::vector<double> cuts = section_ends;
  auto next_end = section_ends.begin();
  double last = 0;
  for (const double place : places) {
    while (next_end + 1 != section_ends.end() && place - *next_end > same_place) ++next_end;
    const bool at_end = std::abs(*next_end - place) <= same_place || place > length;
    if (at_end || place - last <= same_place) continue;
    cuts.push_back(place);
    last = place;
  }
  std::sort(cuts.begin(), cuts.end());
  return cuts;
}

// Index of the cut nearest to a place.
std::size_t nearest_cut(const std::vector<double>& cuts, double place) {
  const auto above = std::lower_bound(cuts.begin() + 1, cuts.end() - 1, place);
  const auto below = above - 1;
  return static_cast<std::size_t>((place - *below < *above - place ? below : above) - cuts.begin());
}

// Adds loads to the spans they act on.
class LoadPlacer {
 public:
  LoadPlacer(const std::vector<double>& cuts, std::vector<Span>& spans) : cuts_(cuts), spans_(spans) {}

  void operator()(const Force& force) {
    Span& span = span_ending_at(force.at_mm);
    const Eigen::Vector3d arm_S_mm(0, force.offset_mm[0], force.offset_mm[1]);
    if (force.frame == Frame::follower) {
      span.follower_load_S.force_N += force.value_N;
      span.follower_load_S.moment_Nmm += arm_S_mm.cross(force.value_N);
    } else {
      span.fixed_load_B.force_N += force.value_N;
      span.fixed_force_arms_BS_Nmm += force.value_N * arm_S_mm.transpose();
    }
  }
  void operator()(const Moment& moment) {
    Span& span = span_ending_at(moment.at_mm);
    (moment.frame == Frame::follower ? span.follower_load_S : span.fixed_load_B).moment_Nmm += moment.value_Nmm;
  }
  void operator()(const DistributedForce& force) {
    const std::size_t end = nearest_cut(cuts_, force.to_mm);
    for (std::size_t i = nearest_cut(cuts_, force.from_mm); i < end; ++i) {
      (force.frame == Frame::follower ? spans_[i].follower_force_S_N_per_mm : spans_[i].fixed_force_B_N_per_mm) +=
          force.value_N_per_mm;
    }
  }
  void operator()(const Gravity& gravity) {
    for (Span& span : spans_) {  // kg/m * m/s^2 = N/m = 1e-3 N/mm
      span.fixed_force_B_N_per_mm += 1e-3 * span.stiffness.mass_per_length_kg_per_m * gravity.acceleration_m_per_s2;
    }
  }
  void operator()(const Tendon& tendon) {
    if (tendon.tension_N == 0) return;
    const Eigen::Vector3d arm_S_mm(0, tendon.offset_mm[0], tendon.offset_mm[1]);
    const std::size_t end = nearest_cut(cuts_, tendon.to_mm);
    for (std::size_t i = 0; i < end; ++i) {
      std::vector<SectionTendon>& tendons = spans_[i].tendons;
      const auto same = std::find_if(tendons.begin(), tendons.end(),
                                     [&](const SectionTendon& other) { return other.arm_S_mm == arm_S_mm; });
      if (same == tendons.end()) tendons.push_back({arm_S_mm, tendon.tension_N});
      else same->tension_N += tendon.tension_N;
    }
  }

 private:
  Span& span_ending_at(double place) { return spans_[nearest_cut(cuts_, place) - 1]; }

  const std::vector<double>& cuts_;
  std::vector<Span>& spans_;
};

}  // namespace

std::vector<Span> spans_of(const Scene& scene) {
  const std::vector<double> cuts = cuts_of(scene, length_mm(scene));
  std::vector<Span> spans(cuts.size() - 1);
  std::size_t section = 0;
  double section_end = scene.sections[0].length_mm;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].start_mm = cuts[i];
    spans[i].end_mm = cuts[i + 1];
    while ((cuts[i] + cuts[i + 1]) / 2 >= section_end && section + 1 < scene.sections.size()) {
      section_end += scene.sections[++section].length_mm;
    }
    spans[i].stiffness = stiffness_of(scene.sections[section]);
    spans[i].rest_curvature_per_mm = scene.sections[section].rest_curvature_per_mm;
  }
  LoadPlacer placer(cuts, spans);
  for (const Load& load : scene.loads) std::visit(placer, load);
  return spans;
}

std::vector<int> cells_per_span(std::span<const Span> spans, int count) {
  const double length = spans.back().end_mm;
  std::vector<int> cells(spans.size());
  std::vector<double> share(spans.size());  // cells wanted beyond those given
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double wanted = count * (spans[i].length_mm() / length);
    cells[i] = std::max(1, static_cast<int>(wanted));
    share[i] = wanted - cells[i];
  }
  int missing = std::max(count, static_cast<int>(spans.size())) - std::accumulate(cells.begin(), cells.end(), 0);

  // Largest remainders get one more; where short spans took more than their share, the longest cells give one up.
  std::vector<std::size_t> order(spans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return share[a] > share[b]; });
  for (std::size_t k = 0; missing > 0; k = (k + 1) % order.size(), --missing) ++cells[order[k]];
  for (std::size_t k = order.size(); missing<0; k = k> 1 ? k - 1 : order.size()) {
    if (cells[order[k - 1]] > 1) --cells[order[k - 1]], ++missing;
  }
  return cells;
}

}  // namespace scene
