#include "fem_reference/stations.h"

#include "fem_reference/beam_element.h"
#include "fem_reference/tendon_pull.h"
#include "scene/load_visitor.h"

#include <algorithm>
#include <cmath>

namespace fem_reference {

namespace {

using Eigen::Vector3d;

constexpr int intervals = 40;  // of the stations that every method gives

// An element's place on the rod.
struct Stretch {
  std::size_t element = 0;
  double start_mm = 0;
  double end_mm = 0;

  double s_mm(double x) const { return x < 1 ? start_mm + x * (end_mm - start_mm) : end_mm; }
  double x(double place_mm) const { return (place_mm - start_mm) / (end_mm - start_mm); }
};

Stretch stretch_of(const scene::Span& span, int cell, int cells, std::size_t first_element) {
  const auto border_mm = [&](int k) {
    return k < cells ? span.start_mm + k * (span.length_mm() / cells) : span.end_mm;
  };
  return {first_element + static_cast<std::size_t>(cell), border_mm(cell), border_mm(cell + 1)};
}

// Where 0 < x <= 1 the element has a station: its nodes, and the places k L/40 that are none of them.
std::vector<double> places(const ReferenceElement& reference, const Stretch& stretch, double length_mm) {
  const auto last = reference.node.data() + reference.nodes();
  std::vector<double> xs(reference.node.data() + 1, last);
  const double interval_mm = length_mm / intervals;
  for (int k = static_cast<int>(std::ceil(stretch.start_mm / interval_mm)); k * interval_mm < stretch.end_mm; ++k) {
    const double x = stretch.x(k * interval_mm);
    const bool is_node = std::any_of(reference.node.data(), last, [&](double node) {
      return std::abs(x - node) * (stretch.end_mm - stretch.start_mm) <= scene::same_place_relative * length_mm;
    });
    if (!is_node && x > 0) xs.push_back(x);
  }
  std::sort(xs.begin(), xs.end());
  return xs;
}

struct TotalWrench {
  Vector3d force_B;
  Vector3d moment_B;
};

// The stations of one element.
class ElementStations {
 public:
  ElementStations(const SolvedBeam& beam, const Stretch& stretch)
      : model_(beam.model),
        data_(beam.model.elements[stretch.element]),
        state_(state_of_element(beam.model, beam.state, stretch.element)),
        stretch_(stretch) {
    ElementResidual residual;
    element_residual(model_.reference, data_, state_, 1, residual);
    ends_ = end_wrenches(model_.reference, state_, residual);
    end_ = section(1);
  }

  std::optional<scene::Station> start() const {
    return station(section(0), stretch_.start_mm, {-ends_.start_force_B, -ends_.start_moment_B});
  }
  std::optional<scene::Station> at(double x) const {
    const SectionState here = x < 1 ? section(x) : end_;
    return station(here, stretch_.s_mm(x), total(x, here));
  }

 private:
  SectionState section(double x) const { return section_at(model_.reference, data_, state_, x); }

  // Equilibrium of the part from x to the element's end.
  TotalWrench total(double x, const SectionState& here) const {
    TotalWrench wrench{ends_.end_force_B, ends_.end_moment_B};
    if (x == 1) return wrench;
    wrench.moment_B += (end_.position_B - here.position_B).cross(wrench.force_B);
    const ReferenceElement& reference = model_.reference;
    for (int g = 0; g < reference.points(); ++g) {
      const SectionState between = section(x + (1 - x) * reference.point(g));
      const Vector3d force_B = reference.weight(g) * (1 - x) * data_.length *
                               (data_.fixed_force_B + between.rotation_BS * data_.follower_force_S);
      wrench.force_B += force_B;
      wrench.moment_B += (between.position_B - here.position_B).cross(force_B);
    }
    return wrench;
  }

  std::optional<scene::Station> station(const SectionState& here, double s_mm, TotalWrench wrench) const {
    if (!data_.tendons.empty()) {
      const Eigen::Matrix3d& R = here.rotation_BS;
      const auto strain =
          strain_under(data_, R.transpose() * wrench.force_B, R.transpose() * wrench.moment_B, here.strain);
      if (!strain) return {};
      const TendonPull pull = tendon_pull(data_, *strain, 1);
      wrench.force_B -= R * pull.force_S;
      wrench.moment_B -= R * pull.moment_S;
    }
    return scene::Station{s_mm,
                          {here.rotation_BS, here.position_B * model_.length_unit_mm},
                          wrench.force_B * model_.force_unit_N,
                          wrench.moment_B * model_.moment_unit_Nmm()};
  }

  const BeamModel& model_;
  const ElementData& data_;
  ElementState state_;
  Stretch stretch_;
  EndWrenches ends_;
  SectionState end_;
};

double shortening_mm(const SolvedBeam& beam, const scene::Tendon& tendon) {
  const BeamModel& model = beam.model;
  const Vector3d arm = Vector3d(0, tendon.offset_mm[0], tendon.offset_mm[1]) / model.length_unit_mm;
  double shortening = 0;
  std::size_t e = 0;
  for (std::size_t i = 0; i < beam.spans.size(); ++i) {
    if (0.5 * (beam.spans[i].start_mm + beam.spans[i].end_mm) > tendon.to_mm) break;
    for (int cell = 0; cell < beam.cells[i]; ++cell, ++e) {
      const ElementData& data = model.elements[e];
      const double rest = (Vector3d::UnitX() + data.rest_curvature.cross(arm)).norm();
      for (int g = 0; g < model.reference.points(); ++g) {
        const SectionStrain strain = element_strain(model.reference, data, state_of_element(model, beam.state, e), g);
        shortening += model.reference.weight(g) * data.length * (rest - (strain.v + strain.u.cross(arm)).norm());
      }
    }
  }
  return shortening * model.length_unit_mm;
}

}  // namespace

std::optional<std::vector<scene::Station>> stations(const SolvedBeam& beam) {
  const double length_mm = beam.spans.back().end_mm;
  std::vector<scene::Station> result;
  std::size_t first_element = 0;
  for (std::size_t i = 0; i < beam.spans.size(); ++i) {
    for (int cell = 0; cell < beam.cells[i]; ++cell) {
      const Stretch stretch = stretch_of(beam.spans[i], cell, beam.cells[i], first_element);
      const ElementStations element(beam, stretch);
      if (stretch.element == 0) {
        const std::optional<scene::Station> clamp = element.start();
        if (!clamp) return {};
        result.push_back(*clamp);
      }
      for (const double x : places(beam.model.reference, stretch, length_mm)) {
        const std::optional<scene::Station> station = element.at(x);
        if (!station) return {};
        result.push_back(*station);
      }
    }
    first_element += static_cast<std::size_t>(beam.cells[i]);
  }
  return result;
}

Vector3d position_B_mm(const SolvedBeam& beam, double s_mm) {
  std::size_t first_element = 0, i = 0;
  for (; i + 1 < beam.spans.size() && beam.spans[i].end_mm < s_mm; ++i) {
    first_element += static_cast<std::size_t>(beam.cells[i]);
  }
  const scene::Span& span = beam.spans[i];
  const int cell = static_cast<int>(beam.cells[i] * (s_mm - span.start_mm) / span.length_mm());
  const Stretch stretch = stretch_of(span, std::clamp(cell, 0, beam.cells[i] - 1), beam.cells[i], first_element);
  const SectionState section = section_at(beam.model.reference, beam.model.elements[stretch.element],
                                          state_of_element(beam.model, beam.state, stretch.element), stretch.x(s_mm));
  return section.position_B * beam.model.length_unit_mm;
}

std::vector<double> tendon_shortening_mm(const SolvedBeam& beam, const std::vector<scene::Load>& loads) {
  std::vector<double> result;
  for (const scene::Load& load : loads) {
    if (const scene::Tendon* tendon = scene::tendon_of(load)) result.push_back(shortening_mm(beam, *tendon));
  }
  return result;
}

}  // namespace fem_reference
