#include "fam/stations.h"

#include "fam/embedding.h"
#include "scene/load_visitor.h"

#include <algorithm>
#include <cmath>

namespace fam {
namespace {

constexpr int intervals = 40;
constexpr double largest_piece_turn_rad = 0.5;

// A place in an arc; s = L k/40 and span ends must be stations, others may.
struct StationPlace {
  double s_mm;
  int arc;
  double fraction;
  bool required;
};

// All candidates in order; each arc's interior is cut so that no piece turns far.
template <int D>
std::vector<StationPlace> places(std::span<const scene::Span> spans, const SolvedRod<D>& rod) {
  const double length_mm = spans.back().end_mm;
  std::vector<StationPlace> result;
  result.reserve(rod.arcs.size() + intervals + 1);
  result.push_back({0, 0, 0, true});
  int next = 1;  // of s = L next/40
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const SpanArcs<D>& arcs = rod.spans[i];
    const int count = arcs.end_arc - arcs.first_arc;
    const double h_mm = spans[i].length_mm() / count;
    for (int k = 0; k < count; ++k) {
      const int arc = arcs.first_arc + k;
      const BasicArc<D>& solved = rod.arcs[static_cast<std::size_t>(arc)];
      const double turn =
          solved.screw.rotation.norm() + std::abs(solved.twist_before_rad) + std::abs(solved.twist_after_rad);
      const int pieces = static_cast<int>(std::clamp(std::ceil(turn / largest_piece_turn_rad), 1.0, 1e4));
      const double start_mm = spans[i].start_mm + k * h_mm;
      for (int piece = 1; piece <= pieces; ++piece) {
        const double end = static_cast<double>(piece) / pieces;
        const bool last = piece == pieces;
        const double end_mm = last && k + 1 == count ? spans[i].end_mm : start_mm + end * h_mm;
        const double hair_mm = scene::same_place_relative * length_mm;
        for (; next < intervals && length_mm * next / intervals < end_mm - hair_mm; ++next) {
          const double s_mm = length_mm * next / intervals;
          const double fraction = std::clamp((s_mm - start_mm) / h_mm, 0.0, 1.0);
          if (s_mm > result.back().s_mm + hair_mm) result.push_back({s_mm, arc, fraction, true});
        }
        const bool at_fortieth = next < intervals && std::abs(length_mm * next / intervals - end_mm) <= hair_mm;
        if (at_fortieth) ++next;
        result.push_back({end_mm, arc, end, at_fortieth || (last && k + 1 == count)});
      }
    }
  }
  return result;
}

// The places that are needed: turns of the rod from one kept to the next are the sum of those between.
template <int D>
std::vector<StationPlace> thinned(std::vector<StationPlace> all, const SolvedRod<D>& rod) {
  std::vector<StationPlace> kept;
  kept.reserve(all.size());
  double turned = 0, fraction_before = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const BasicArc<D>& arc = rod.arcs[static_cast<std::size_t>(all[i].arc)];
    const double turn = arc.screw.rotation.norm() + std::abs(arc.twist_before_rad) + std::abs(arc.twist_after_rad);
    const double step = turn * (all[i].fraction - fraction_before);
    if (turned > 0 && turned + step > largest_piece_turn_rad && !all[i - 1].required) {
      kept.push_back(all[i - 1]);
      turned = 0;
    }
    turned += step;
    fraction_before = all[i].fraction >= 1 ? 0 : all[i].fraction;
    if (!all[i].required) continue;
    kept.push_back(all[i]);
    turned = 0;
  }
  return kept;
}

template <int D>
scene::Station station(double s_mm, const typename BasicShape<D>::Section& section, const Matrix3d& rotation_BP) {
  const SectionPose pose = in_base(section.pose, rotation_BP);
  return {s_mm,
          {pose.rotation_BS, pose.position_B_mm},
          in_base(section.own_B.force_N, rotation_BP),
          angular_in_base(section.own_B.moment_Nmm, rotation_BP)};
}

// Length of t = v + u x r per mm of rod.
double stretch(const Vector3d& u, const Vector3d& v, const Vector3d& arm_mm) {
  return (v + u.cross(arm_mm)).norm();
}

// int |e_x + u0 x r| ds - int |v + u x r| ds by Gauss' rule of order eight on each arc, section frames.
class Shortenings {
 public:
  Shortenings(const scene::Scene& scene, std::vector<double>& shortening_mm) : shortening_mm_(shortening_mm) {
    for (const scene::Load& load : scene.loads) {
      if (const scene::Tendon* tendon = scene::tendon_of(load)) tendons_.push_back(tendon);
    }
    shortening_mm.assign(tendons_.size(), 0);
  }

  template <int D>
  void add(ArcInterior<D>& arc, const scene::Span& span, const Matrix3d& rotation_BP) {
    if (tendons_.empty()) return;
    const double middle_mm = (span.start_mm + span.end_mm) / 2, h_mm = arc.span().constants.length_mm;
    for (std::size_t g = 0; g < gauss_points.size(); ++g) {
      const BasicScrew<double, D> strain_per_mm = arc.strain_per_mm(gauss_points[g]);
      const Vector3d u = angular_in_base(strain_per_mm.rotation, rotation_BP),
                     v = in_base(strain_per_mm.translation_mm, rotation_BP);
      for (std::size_t t = 0; t < tendons_.size(); ++t) {
        if (middle_mm > tendons_[t]->to_mm) continue;
        const Vector3d arm_mm(0, tendons_[t]->offset_mm[0], tendons_[t]->offset_mm[1]);
        const double at_rest = stretch(span.rest_curvature_per_mm, Vector3d::UnitX(), arm_mm);
        shortening_mm_[t] += gauss_weights[g] * h_mm * (at_rest - stretch(u, v, arm_mm));
      }
    }
  }

 private:
  std::vector<const scene::Tendon*> tendons_;
  std::vector<double>& shortening_mm_;
};

}  // namespace

template <int D>
void set_shape(scene::Equilibrium& result, const scene::Scene& scene, std::span<const scene::Span> spans,
               const SolvedRod<D>& rod, const Matrix3d& rotation_BP) {
  const std::vector<StationPlace> kept = thinned(places(spans, rod), rod);
  result.stations.assign(kept.size(), {});
  Shortenings shortenings(scene, result.tendon_shortening_mm);
  BasicShape<D> shape;
  std::size_t end = kept.size();  // of the places not met yet
  shape.set(rod, [&](ArcInterior<D>& arc) {
    PlacesAtOnce fractions;
    while (end > 0 && kept[end - 1].arc == arc.arc()) {
      std::size_t count = 0;
      while (count < places_at_once && count < end && kept[end - 1 - count].arc == arc.arc()) {
        fractions[count] = kept[end - 1 - count].fraction;
        ++count;
      }
      const auto sections = shape.sections(arc, {fractions.data(), count});
      for (std::size_t i = 0; i < count; ++i, --end)
        result.stations[end - 1] = station<D>(kept[end - 1].s_mm, sections[i], rotation_BP);
    }
    shortenings.add(arc, spans[static_cast<std::size_t>(&arc.span() - rod.spans.data())], rotation_BP);
  });
}

template void set_shape(scene::Equilibrium&, const scene::Scene&, std::span<const scene::Span>, const SolvedRod<2>&,
                        const Matrix3d&);
template void set_shape(scene::Equilibrium&, const scene::Scene&, std::span<const scene::Span>, const SolvedRod<3>&,
                        const Matrix3d&);

}  // namespace fam
