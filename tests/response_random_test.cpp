// Derivatives of random scenes' tips against differences of the exact reference: one by each of a load, a place, a rest
// curvature, a stiffness and a small force at the tip.
#include "exact_reference/solve.h"
#include "response_support.h"
#include "studies/scenes/random_scene.h"

#include <gtest/gtest.h>

#include <optional>

using namespace support;
using scene::Scene;

namespace {

constexpr double limit = 1e-7;           // of a block's largest entry, positions over L: the issue's
constexpr double judge_limit = 1e-8;     // as the differences' own levels tell
constexpr double moved = 1e-2;           // by a difference's step: over L, or in rad
constexpr double most_of_tension = 0.1;  // that a difference's step takes
constexpr double round_off = 1e-12;      // of the exact reference's tips

std::optional<scene::Pose> exact_tip(const Scene& scene) {
  const scene::Equilibrium exact =
      exact_reference::solve(scene, {.model = scene::RodModel::reissner, .tolerance = 1e-12});
  if (!exact.converged() || exact.error_estimate_mm > 1e-11 * scene::length_mm(scene)) return std::nullopt;
  return exact.tip();
}

// Central differences over h, extrapolated from h, h/2 and h/4: the derivative, and how far the last two levels part.
struct Extrapolated {
  Vector6 value;
  double uncertainty;
};
template <class Change>
std::optional<Extrapolated> differences(const Change& changed_by, double h, double length_mm) {
  Vector6 central[3];
  for (int level = 0; level < 3; ++level, h /= 2) {
    const std::optional<scene::Pose> more = exact_tip(changed_by(h)), less = exact_tip(changed_by(-h));
    if (!more || !less) return std::nullopt;
    const Eigen::Matrix3d turn = more->rotation_BS * less->rotation_BS.transpose();
    central[level] << (more->position_B_mm - less->position_B_mm) / length_mm, fam::rotation_vector(turn);
    central[level] /= 2 * h;
  }
  const Vector6 coarse = (4 * central[1] - central[0]) / 3, fine = (4 * central[2] - central[1]) / 3;
  const Vector6 value = (16 * fine - coarse) / 15;
  return Extrapolated{value, (value - fine).cwiseAbs().maxCoeff()};
}

struct Sums {
  int scenes = 0, judged = 0, unjudged = 0;
  double largest = 0;
};

// `block`: FAM's, of which the exact reference judges a column.
template <class Block, class Change>
void judge(Block block, int column, const Change& changed_by, const Scene& scene, const std::string& name, Sums& sums,
           double longest_step) {
  const double length_mm = scene::length_mm(scene);
  block.template topRows<3>() /= length_mm;
  const double size = block.cwiseAbs().maxCoeff(), own = block.col(column).cwiseAbs().maxCoeff();
  const double h = std::min(moved / own, longest_step);
  if (!(round_off / h <= judge_limit / 4 * size)) return;  // the differences would be lost in round-off
  const auto expected = differences(changed_by, h, length_mm);
  if (!expected || !(expected->uncertainty <= judge_limit * size)) {
    ++sums.unjudged;
    return;
  }
  ++sums.judged;
  const double error = (block.col(column) - expected->value).cwiseAbs().maxCoeff() / size;
  sums.largest = std::max(sums.largest, error);
  EXPECT_LE(error, limit) << scene.title << ", by " << name << ", component " << column;
}

double longest_step(const Scene& scene, const fam::Parameter& parameter) {
  const double step = step_of(scene, parameter);
  const auto* tendon =
      parameter.kind == Kind::load ? std::get_if<scene::Tendon>(&scene.loads[parameter.index]) : nullptr;
  return tendon ? std::min(step, most_of_tension * tendon->tension_N) : step;
}

void judge_scene(std::uint64_t seed, Sums& sums) {
  const Scene scene = studies::random_scene(seed);
  const double L = scene::length_mm(scene);
  fam::Options options;
  options.model = scene::RodModel::reissner;
  options.tolerance_mm = 1e-11 * L;  // slopes need more arcs than shapes: near a critical load, and out of a plane
  options.reserved_arcs = 8192;
  auto made = fam::Solver::make(scene, options);
  auto& solver = std::get<fam::Solver>(made);
  if (!solver.solve().converged() || !(solver.error_estimate_mm() <= 10 * options.tolerance_mm)) return;
  ++sums.scenes;
  const auto by = [&](const fam::Parameter& parameter, const std::string& name, const auto& block) {
    const auto changed_by = [&](double h) { return changed(scene, parameter, h); };
    judge(block, parameter.component, changed_by, scene, name, sums, longest_step(scene, parameter));
  };
  const int component = static_cast<int>(seed % 3);
  for (std::size_t i = seed % 2; i < scene.loads.size(); i += 3) {  // a third of the loads
    const bool tendon = std::holds_alternative<scene::Tendon>(scene.loads[i]);
    by({Kind::load, i, tendon ? 0 : component}, "load " + std::to_string(i), solver.by_load(i, L));
  }
  const std::size_t section = seed % scene.sections.size();
  by({Kind::rest_curvature, section, component}, "rest curvature", solver.by_rest_curvature(section, L));
  by({Kind::stiffness, section, component}, "stiffness", solver.by_stiffness(section, L));
  const auto pulled = [&](double h) {
    Scene with = scene;
    with.loads.push_back(scene::Force{L, scene::Frame::fixed, h * Eigen::Vector3d::Unit(component)});
    return with;
  };
  judge(Eigen::Matrix<double, 6, 3>(solver.compliance(L).leftCols<3>()), component, pulled, scene, "compliance", sums,
        step_of(pulled(0), {Kind::load, scene.loads.size(), 0}));
}

void judge_scenes(std::uint64_t from, int scenes) {
  Sums sums;
  for (std::uint64_t i = from; sums.scenes < scenes; ++i) judge_scene(studies::mixed_seed(i), sums);
  std::cout << sums.judged << " derivatives of " << sums.scenes << " scenes judged, " << sums.unjudged
            << " not; largest error " << sums.largest << "\n";
  EXPECT_GE(sums.judged, scenes);
}

TEST(DerivativesOfRandomScenes, MatchTheExactReference) {
  judge_scenes(0, 12);
}
// The ctest derivatives_more, of the label slow.
TEST(DerivativesOfRandomScenes, DISABLED_MoreMatchTheExactReference) {
  judge_scenes(0, 200);
}

}  // namespace
