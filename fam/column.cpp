#include "fam/column.h"

#include "fam/load_length.h"
#include "scene/span_facts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fam {
namespace {

using scene::Span;

constexpr int most_cells = 1024;  // of a span
// Stretch and shear: up to it P falls with N, so that its steps are those at the ends of a cell.
constexpr double most_strain = 0.1;

// Of the pressing force, by which the steps are farther from it: nearer to a critical one rounding may decide. Chosen.
constexpr double margin = 1e-10;

enum class Steps { below, above };  // the pressing force that they stand for

double tension_N(const Span& span) {
  double sum_N = 0;
  for (const scene::SectionTendon& tendon : span.tendons) sum_N += tendon.tension_N;
  return sum_N;
}

// P of column.h, in a plane of bending under this pull.
double pressing_N(const Span& span, RodModel model, int plane, double pull_N) {
  if (model == RodModel::kirchhoff) return -pull_N;
  const double tendons_N = tension_N(span);
  const double stretched = span.stiffness.axial_N ? 1 + (pull_N - tendons_N) / *span.stiffness.axial_N : 1;
  const std::optional<Eigen::Vector2d>& shear_N = span.stiffness.shear_N;  // bending about y moves along z
  const double by_shear_N = shear_N ? pull_N * pull_N / ((*shear_N)[1 - plane] + tendons_N / stretched) : 0;
  return -pull_N * stretched + by_shear_N;
}

bool is_small(const Span& span, RodModel model, double pull_N) {
  const double size_N = std::abs(pull_N) + tension_N(span);
  return model == RodModel::kirchhoff || size_N * linear_compliance_per_N(span) <= most_strain;
}

bool strains_are_small(std::span<const Span> spans, RodModel model) {
  double pull_N = 0;
  bool small = true;
  for (std::size_t i = spans.size(); i-- > 0;) {
    pull_N += spans[i].fixed_load_B.force_N[0];
    small = small && is_small(spans[i], model, pull_N);
    pull_N += spans[i].fixed_force_B_N_per_mm[0] * spans[i].length_mm();
    small = small && is_small(spans[i], model, pull_N);
  }
  return small;
}

// theta'/theta from a cell's distal end to its proximal one, if theta keeps its sign.
bool stays_positive(double& slope, double pressing_over_EI, double length_mm) {
  const double k = std::sqrt(std::abs(pressing_over_EI)), x = k * length_mm;
  double turn = 1;  // theta, which was 1 at the distal end
  if (pressing_over_EI > 0) {
    if (x >= std::numbers::pi) return false;  // no sine is longer
    turn = std::cos(x) + slope / k * std::sin(x);
    slope = slope * std::cos(x) - k * std::sin(x);
  } else if (pressing_over_EI < 0) {  // both over cosh x
    turn += slope / k * std::tanh(x);
    slope += k * std::tanh(x);
  } else {
    turn += slope * length_mm;
  }
  slope /= turn;
  return turn > 0;
}

// Whether the turn in a plane of bending vanishes nowhere, P taken as the steps say.
bool is_positive(std::span<const Span> spans, RodModel model, int plane, int cells, Steps steps) {
  double pull_N = 0, moment_Nmm = 0;  // EI theta' / theta
  for (std::size_t i = spans.size(); i-- > 0;) {
    const Span& span = spans[i];
    pull_N += span.fixed_load_B.force_N[0];
    const double length_mm = span.length_mm() / cells, stiffness_Nmm2 = span.stiffness.bending_Nmm2[plane];
    const double growth_N = span.fixed_force_B_N_per_mm[0] * length_mm;
    double slope_per_mm = moment_Nmm / stiffness_Nmm2;
    for (int k = 0; k < cells; ++k) {
      const double distal_N = pressing_N(span, model, plane, pull_N);
      pull_N += growth_N;
      const double proximal_N = pressing_N(span, model, plane, pull_N);
      const double away_N = margin * std::max(std::abs(distal_N), std::abs(proximal_N));
      const double step_N =
          steps == Steps::above ? std::max(distal_N, proximal_N) + away_N : std::min(distal_N, proximal_N) - away_N;
      if (!stays_positive(slope_per_mm, step_N / stiffness_Nmm2, length_mm)) return false;
    }
    moment_Nmm = slope_per_mm * stiffness_Nmm2;
  }
  return true;
}

}  // namespace

bool is_column(std::span<const Span> spans) {
  return scene::needs_no_plane(spans) && scene::is_conservative(spans) &&
         std::all_of(spans.begin(), spans.end(), [](const Span& span) { return span.rest_curvature_per_mm.isZero(0); });
}

std::optional<bool> is_stable_column(std::span<const Span> spans, RodModel model) {
  if (!strains_are_small(spans, model)) return std::nullopt;
  for (int cells = 1; cells <= most_cells; cells *= 4) {
    const auto positive = [&](Steps steps) {
      return is_positive(spans, model, 0, cells, steps) && is_positive(spans, model, 1, cells, steps);
    };
    if (positive(Steps::above)) return true;
    if (!positive(Steps::below)) return false;
  }
  return std::nullopt;
}

}  // namespace fam
