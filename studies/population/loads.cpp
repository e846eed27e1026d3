#include "studies/population/loads.h"

#include "fam/solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace studies {
namespace {

using Eigen::Vector3d;

bool has_shear(Side side) {
  return side != Side::follower_kirchhoff && side != Side::fixed_kirchhoff;
}

scene::Frame force_frame(Side side) {
  const bool fixed = side == Side::fixed || side == Side::fixed_kirchhoff || side == Side::fixed_force;
  return fixed ? scene::Frame::fixed : scene::Frame::follower;
}

scene::Frame moment_frame(Side side) {
  const bool fixed = side == Side::fixed || side == Side::fixed_kirchhoff || side == Side::fixed_moment;
  return fixed ? scene::Frame::fixed : scene::Frame::follower;
}

// One rod as one side sees it, kept for all its loads. 16 arcs of sixth order: the tests hold its tips to those of the
// deal.II beam.
class SideRod {
 public:
  SideRod(double length_mm, const scene::Stiffness& stiffness, bool planar, Side side)
      : solver_(make(length_mm, stiffness, planar, side)) {}

  Vector3d tip_mm(const TipLoad& load) {
    if (!solver_) return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    solver_->set_force_N(0, load.force_N);
    solver_->set_moment_Nmm(1, load.moment_Nmm);
    if (!solver_->solve(fam::Solver::Start::unloaded).converged())
      return Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    return solver_->tip().position_B_mm;
  }

 private:
  static std::optional<fam::Solver> make(double length_mm, const scene::Stiffness& stiffness, bool planar, Side side) {
    TipLoad any;
    any.planar = planar;
    any.force_N = planar ? Vector3d(1, 1, 0) : Vector3d(1, 1, 1);
    any.moment_Nmm = planar ? Vector3d(0, 0, 1) : Vector3d(1, 1, 1);
    fam::Options options;
    options.arcs = options.reserved_arcs = 16;
    options.estimate_error = false;
    options.tolerance_mm = 1e-9 * length_mm;
    options.model = has_shear(side) ? fam::RodModel::reissner : fam::RodModel::kirchhoff;
    auto made = fam::Solver::make(scene_of(length_mm, stiffness, any, side), options);
    if (fam::Solver* solver = std::get_if<fam::Solver>(&made)) return std::move(*solver);
    return std::nullopt;
  }

  std::optional<fam::Solver> solver_;
};

// Draws one set. The unit of forces is EI/L^2, of moments EI/L.
class SetDrawing {
 public:
  SetDrawing(const PopulationRod& rod, LoadPrior prior, std::uint64_t seed) : rod_(rod), engine_(seed) {
    for (int i = 0; i < 8; ++i) engine_();  // neighbouring seeds part
    set_.prior = prior;
    set_.planar_stiffness = stiffness(rod.planar_bending_Nmm2);
    set_.spatial_stiffness = set_.planar_stiffness;
    const double factor = rod.spatial_bending_Nmm2 / rod.planar_bending_Nmm2;  // the same section of another material
    set_.spatial_stiffness.torsion_Nmm2 *= factor;
    set_.spatial_stiffness.bending_Nmm2 *= factor;
    *set_.spatial_stiffness.axial_N *= factor;
    *set_.spatial_stiffness.shear_N *= factor;
  }

  LoadSet drawn() {
    draw_cases(true, rod_.planar_cases, rod_.planar_bending_Nmm2, set_.planar_stiffness);
    draw_cases(false, rod_.spatial_cases, rod_.spatial_bending_Nmm2, set_.spatial_stiffness);
    return std::move(set_);
  }

 private:
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
  }
  std::size_t one_of(std::size_t count) { return static_cast<std::size_t>(uniform(0, static_cast<double>(count))); }

  // Solid circle, tube or square of the printed size and the printed EI; nu from 0.3 to 0.5. (A rectangle has two EI,
  // and one is printed.)
  scene::Stiffness stiffness(double bending_Nmm2) {
    const double nu = uniform(0.3, 0.5), d = rod_.diameter_mm;
    const std::size_t shape = one_of(3);
    const double hole = uniform(0.3, 0.9);
    scene::Stiffness s;
    if (shape == 2) {
      // Square: St Venant's torsion 0.14058 d^4, Cowper's shear coefficient of a rectangle.
      const double area_over_I = 12 / (d * d), two_G = 1 / (1 + nu);  // over E
      s.bending_Nmm2 = Eigen::Vector2d::Constant(bending_Nmm2);
      s.torsion_Nmm2 = bending_Nmm2 * 0.14058 * 12 * two_G / 2;
      s.axial_N = bending_Nmm2 * area_over_I;
      s.shear_N = Eigen::Vector2d::Constant(bending_Nmm2 * area_over_I * two_G / 2 * 10 * (1 + nu) / (12 + 11 * nu));
      return s;
    }
    scene::CircularSection section{d, shape == 1 ? hole * d : 0, 1, nu, 0};
    section.youngs_modulus_MPa = bending_Nmm2 / scene::stiffness_of(section).bending_Nmm2[0];
    s = scene::stiffness_of(section);
    s.bending_Nmm2 = Eigen::Vector2d::Constant(bending_Nmm2);
    return s;
  }

  // In units. Planar: F_x, F_y, M_z; spatial: all six. The torque: up to the largest that the paper prints, 50 N mm.
  // Chosen, not measured: three units move the tip by about its length.
  static constexpr double largest_load = 3, largest_torque = 4 / 3.;
  static double largest(std::size_t component, std::size_t count) {
    return count == 6 && component == 3 ? largest_torque : largest_load;
  }

  std::vector<double> components(std::size_t count) {
    std::vector<double> c(count);
    for (std::size_t i = 0; i < count; ++i) c[i] = uniform(-1, 1) * largest(i, count);
    return c;
  }

  // One to three (planar) or two to four (spatial) of the components, each a round number: 1, 1.5, 2, 2.5, 3, 4, 5, 6
  // or 8 times a power of ten, in N or N mm.
  double round_number(double size) {
    static constexpr std::array round = {1., 1.5, 2., 2.5, 3., 4., 5., 6., 8., 10.};
    const double power = std::pow(10, std::floor(std::log10(size)));
    return power * *std::min_element(round.begin(), round.end(), [&](double a, double b) {
             return std::abs(a - size / power) < std::abs(b - size / power);
           });
  }
  std::vector<double> round_components(std::size_t count, double force_unit_N, double moment_unit_Nmm) {
    std::vector<double> c(count, 0);
    const std::size_t some = (count == 3 ? 1 : 2) + one_of(3);
    for (std::size_t i = 0; i < some; ++i) {
      const std::size_t at = one_of(count);
      const double unit = at < (count == 3 ? 2U : 3U) ? force_unit_N : moment_unit_Nmm;
      const double size = round_number(unit * std::exp(uniform(std::log(0.1), std::log(largest(at, count))))) / unit;
      c[at] = uniform(0, 1) < 0.5 ? size : -size;
    }
    return c;
  }

  TipLoad load_of(bool planar, const std::vector<double>& c, double force_unit_N, double moment_unit_Nmm) const {
    TipLoad load;
    load.planar = planar;
    load.force_N = force_unit_N * (planar ? Vector3d(c[0], c[1], 0) : Vector3d(c[0], c[1], c[2]));
    load.moment_Nmm = moment_unit_Nmm * (planar ? Vector3d(0, 0, c[2]) : Vector3d(c[3], c[4], c[5]));
    return load;
  }

  double displacement(SideRod& rod, const TipLoad& load) const {
    return (rod.tip_mm(load) - rod_.length_mm * Vector3d::UnitX()).norm() / rod_.length_mm;
  }

  // The least multiple of a load that moves the tip by this, to 1e-3; 0 where up to 8 times does not.
  double multiple_for(SideRod& rod, const TipLoad& load, double wanted) const {
    const auto scaled = [&](double t) {
      TipLoad result = load;
      result.force_N *= t;
      result.moment_Nmm *= t;
      return displacement(rod, result);
    };
    double low = 0, high = 0.02;
    while (!(scaled(high) >= wanted)) {
      low = high;
      if ((high *= 1.3) > 8) return 0;
    }
    while (high - low > 1e-3 * high) {
      const double middle = (low + high) / 2;
      (scaled(middle) < wanted ? low : high) = middle;
    }
    return high;
  }

  TipLoad draw_load(bool planar, SideRod& rod, double force_unit_N, double moment_unit_Nmm) {
    const std::size_t count = planar ? 3 : 6;
    if (set_.prior == LoadPrior::round) {
      return load_of(planar, round_components(count, force_unit_N, moment_unit_Nmm), force_unit_N, moment_unit_Nmm);
    }
    TipLoad load = load_of(planar, components(count), force_unit_N, moment_unit_Nmm);
    if (set_.prior == LoadPrior::deflection) {
      const double multiple = multiple_for(rod, load, uniform(least_displacement, largest_displacement));
      load.force_N *= multiple;
      load.moment_Nmm *= multiple;
    }
    return load;
  }

  // "Not coplanar": neither in the x-y nor in the x-z plane.
  static bool is_spatial(const TipLoad& load) {
    const Vector3d &f = load.force_N, &m = load.moment_Nmm;
    const bool in_xy = f[2] == 0 && m[0] == 0 && m[1] == 0, in_xz = f[1] == 0 && m[0] == 0 && m[2] == 0;
    return !in_xy && !in_xz;
  }

  void draw_cases(bool planar, int count, double bending_Nmm2, const scene::Stiffness& stiffness) {
    const double moment_unit_Nmm = bending_Nmm2 / rod_.length_mm, force_unit_N = moment_unit_Nmm / rod_.length_mm;
    std::vector<SideRod> sides;
    for (std::size_t side = 0; side < side_count; ++side)
      sides.emplace_back(rod_.length_mm, stiffness, planar, static_cast<Side>(side));
    for (int drawn = 0; drawn < count;) {
      TipCase c;
      c.load = draw_load(planar, sides[0], force_unit_N, moment_unit_Nmm);
      const double moved = displacement(sides[0], c.load);
      bool taken = moved >= least_displacement * 0.999 && moved <= largest_displacement * 1.001 &&
                   (planar || is_spatial(c.load));
      for (std::size_t side = 0; side < side_count && taken; ++side) {
        c.tip_mm[side] = sides[side].tip_mm(c.load);
        taken = c.tip_mm[side].allFinite();
      }
      if (!taken) {
        ++set_.redrawn;
        continue;
      }
      set_.cases.push_back(c);
      ++drawn;
    }
  }

  const PopulationRod& rod_;
  std::mt19937_64 engine_;
  LoadSet set_;
};

}  // namespace

const char* name(LoadPrior prior) {
  static constexpr std::array names = {"load", "deflection", "round"};
  return names[static_cast<std::size_t>(prior)];
}

scene::Scene scene_of(double length_mm, const scene::Stiffness& stiffness, const TipLoad& load, Side side) {
  scene::Scene scene;
  scene.sections.push_back({length_mm, stiffness, Vector3d::Zero()});
  scene.loads.push_back(scene::Force{length_mm, force_frame(side), load.force_N, Eigen::Vector2d::Zero()});
  scene.loads.push_back(scene::Moment{length_mm, moment_frame(side), load.moment_Nmm});
  return scene;
}

std::vector<Vector3d> tips_of(double length_mm, const scene::Stiffness& stiffness, const std::vector<TipLoad>& loads,
                              Side side) {
  std::vector<Vector3d> tips;
  if (loads.empty()) return tips;
  SideRod rod(length_mm, stiffness, loads.front().planar, side);
  for (const TipLoad& load : loads) tips.push_back(rod.tip_mm(load));
  return tips;
}

LoadSet draw_load_set(const PopulationRod& rod, LoadPrior prior, std::uint64_t seed) {
  return SetDrawing(rod, prior, seed).drawn();
}

LoadSet load_set(const PopulationRod& rod, std::uint64_t index) {
  constexpr std::uint64_t first_seed = 20'000'000;
  return draw_load_set(rod, all_load_priors[index % all_load_priors.size()], first_seed + index);
}

}  // namespace studies
