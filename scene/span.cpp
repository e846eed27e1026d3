#include "scene/span.h"

#include "scene/load_visitor.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scene {
namespace {

// Calls place(s) where a load begins or ends.
template <class Place>
void for_places(const Load& load, Place&& place) {
  visit_load(
      load, [&](const Force& force) { place(force.at_mm); }, [&](const Moment& moment) { place(moment.at_mm); },
      [&](const DistributedForce& force) { place(force.from_mm), place(force.to_mm); },  //
      [&](const Gravity&) {}, [&](const Tendon& tendon) { place(tendon.to_mm); });
}

// Adds loads to the spans they act on.
class LoadPlacer {
 public:
  LoadPlacer(const SpanCutter& cutter, Reused<Span>& spans) : cutter_(cutter), spans_(spans) {}

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
    const std::size_t end = cutter_.nearest_cut(force.to_mm);
    for (std::size_t i = cutter_.nearest_cut(force.from_mm); i < end; ++i) {
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
    const std::size_t end = cutter_.nearest_cut(tendon.to_mm);
    for (std::size_t i = 0; i < end; ++i) {
      std::vector<SectionTendon>& tendons = spans_[i].tendons;
      const auto same = std::find_if(tendons.begin(), tendons.end(),
                                     [&](const SectionTendon& other) { return other.arm_S_mm == arm_S_mm; });
      if (same == tendons.end()) tendons.push_back({arm_S_mm, tendon.tension_N});
      else same->tension_N += tendon.tension_N;
    }
  }

 private:
  Span& span_ending_at(double place) { return spans_[cutter_.nearest_cut(place) - 1]; }

  const SpanCutter& cutter_;
  Reused<Span>& spans_;
};

}  // namespace

void Span::unload() {
  follower_load_S = fixed_load_B = {};
  fixed_force_arms_BS_Nmm.setZero();
  follower_force_S_N_per_mm.setZero();
  fixed_force_B_N_per_mm.setZero();
  tendons.clear();
}

void SpanCutter::reserve(const Scene& scene, std::size_t scenes) {
  const std::size_t ends = scene.sections.size() + 1, places = 2 * scenes * scene.loads.size();
  section_ends_.reserve(ends);
  places_.reserve(places);
  cuts_.reserve(ends + places);
  section_of_span_.reserve(ends + places);
}

// Sorted places at which spans end, the clamp first. Section ends are kept exactly; other places closer than
// same_place_relative * L to a kept one are that one, and shorter sections vanish.
void SpanCutter::cut(std::span<const Scene* const> scenes) {
  const Scene& scene = *scenes.front();
  const double length = length_mm(scene), same_place = same_place_relative * length;
  section_ends_.assign(1, 0);
  double end = 0;
  for (const Section& section : scene.sections) {
    end += section.length_mm;
    if (end - section_ends_.back() > same_place) section_ends_.push_back(end);
  }
  places_.clear();
  for (const Scene* each : scenes) {
    for (const Load& load : each->loads) for_places(load, [this](double place) { places_.push_back(place); });
  }
  std::sort(places_.begin(), places_.end());

  cuts_.assign(section_ends_.begin(), section_ends_.end());
  auto next_end = section_ends_.begin();
  double last = 0;
  for (const double place : places_) {
    while (next_end + 1 != section_ends_.end() && place - *next_end > same_place) ++next_end;
    const bool at_end = std::abs(*next_end - place) <= same_place || place > length;
    if (at_end || place - last <= same_place) continue;
    cuts_.push_back(place);
    last = place;
  }
  std::sort(cuts_.begin(), cuts_.end());

  section_of_span_.clear();
  std::size_t section = 0;
  double section_end = scene.sections[0].length_mm;
  for (std::size_t i = 0; i + 1 < cuts_.size(); ++i) {
    while ((cuts_[i] + cuts_[i + 1]) / 2 >= section_end && section + 1 < scene.sections.size()) {
      section_end += scene.sections[++section].length_mm;
    }
    section_of_span_.push_back(section);
  }
}

std::size_t SpanCutter::nearest_cut(double place_mm) const {
  const auto above = std::lower_bound(cuts_.begin() + 1, cuts_.end() - 1, place_mm);
  const auto below = above - 1;
  return static_cast<std::size_t>((place_mm - *below < *above - place_mm ? below : above) - cuts_.begin());
}

void SpanCutter::fill(const Scene& scene, Reused<Span>& spans) const {
  spans.resize(section_of_span_.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    spans[i].unload();
    spans[i].start_mm = cuts_[i];
    spans[i].end_mm = cuts_[i + 1];
    spans[i].stiffness = stiffness_of(scene.sections[section_of_span_[i]]);
    spans[i].rest_curvature_per_mm = scene.sections[section_of_span_[i]].rest_curvature_per_mm;
  }
  LoadPlacer placer(*this, spans);
  for (const Load& load : scene.loads) std::visit(placer, load);
}

std::vector<Span> spans_of(const Scene& scene) {
  SpanCutter cutter;
  const Scene* const scenes[] = {&scene};
  cutter.cut(scenes);
  Reused<Span> spans;
  cutter.fill(scene, spans);
  return {spans.begin(), spans.end()};
}

std::vector<int> cells_per_span(std::span<const Span> spans, int count) {
  std::vector<int> cells;
  CellShares shares;
  share_cells(spans, count, cells, shares);
  return cells;
}

void share_cells(std::span<const Span> spans, int count, std::vector<int>& cells, CellShares& shares) {
  const double length = spans.back().end_mm;
  cells.resize(spans.size());
  std::vector<double>& share = shares.share;  // cells wanted beyond those given
  share.resize(spans.size());
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const double wanted = count * (spans[i].length_mm() / length);
    cells[i] = std::max(1, static_cast<int>(wanted));
    share[i] = wanted - cells[i];
  }
  int missing = std::max(count, static_cast<int>(spans.size())) - std::accumulate(cells.begin(), cells.end(), 0);

  // Largest remainders get one more; where short spans took more than their share, the longest cells give one up.
  std::vector<std::size_t>& order = shares.order;
  order.resize(spans.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return share[a] != share[b] ? share[a] > share[b] : a < b; });
  for (std::size_t k = 0; missing > 0; k = (k + 1) % order.size(), --missing) ++cells[order[k]];
  for (std::size_t k = order.size(); missing<0; k = k> 1 ? k - 1 : order.size()) {
    if (cells[order[k - 1]] > 1) --cells[order[k - 1]], ++missing;
  }
}

}  // namespace scene
