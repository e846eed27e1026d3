#include "studies/scenes/random_scene.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace studies {
namespace {

using Eigen::Vector2d, Eigen::Vector3d;

constexpr double ten_turns_rad = 20 * std::numbers::pi;

// Draws one scene. The unit of forces is EI/L^2, of moments EI/L, EI being that of the uniform rod that bends as much
// under a moment at its tip: L / integral of ds/EI, with the lesser of the two EI of each section.
class Drawing {
 public:
  Drawing(std::uint64_t seed, const RandomSceneLimits& limits) : engine_(seed), limits_(limits) {
    for (int i = 0; i < 8; ++i) engine_();  // neighbouring seeds part
  }

  scene::Scene buckling() {
    length_mm_ = log_uniform(1, 1e3);
    const double bending_Nmm2 = log_uniform(1, 1e6);
    force_unit_N_ = bending_Nmm2 / (length_mm_ * length_mm_);
    const bool strip = chance(0.25);
    const double ratio = strip ? log_uniform(3, 1e4) : chance(0.5) ? 1 : log_uniform(0.1, 10);
    const double torsion = chance(0.7) ? uniform(0.3, 1) : log_uniform(0.01, 10);
    scene::Stiffness stiffness;
    stiffness.bending_Nmm2 = bending_Nmm2 * Vector2d(ratio, 1);
    stiffness.torsion_Nmm2 = bending_Nmm2 * torsion;
    scene_.sections.push_back({length_mm_, stiffness, Vector3d::Zero()});
    if (strip) {  // Prandtl's and Michell's load
      const double critical = 4.0126 * std::sqrt(torsion);
      add_tip_force(scene::Frame::fixed, critical * log_uniform(0.5, 5) * Vector3d::UnitZ());
    } else {  // Euler's load
      const double critical = std::min(1.0, ratio) * std::pow(std::numbers::pi / 2, 2);
      add_tip_force(chance(0.75) ? scene::Frame::fixed : scene::Frame::follower,
                    -critical * log_uniform(0.5, 50) * Vector3d::UnitX());
    }
    if (chance(0.3)) add_tip_moment(frame(), sign() * log_uniform(0.01, 5) * Vector3d::UnitX());
    draw_disturbances();
    return std::move(scene_);
  }

  // Lengths and stiffnesses do not matter to dimensionless answers: L = 100 mm, EI = 1500 N mm^2.
  scene::Scene family(std::uint64_t index) {
    constexpr double bending_Nmm2 = 1500;
    length_mm_ = 100;
    force_unit_N_ = bending_Nmm2 / (length_mm_ * length_mm_);
    scene::Stiffness stiffness;
    stiffness.bending_Nmm2.setConstant(bending_Nmm2);
    stiffness.torsion_Nmm2 = bending_Nmm2 * (chance(0.9) ? uniform(0.3, 1) : log_uniform(1e-4, 10));
    scene_.sections.push_back({length_mm_, stiffness, Vector3d::Zero()});
    switch (index) {
      case 0: draw_strip(); break;
      case 1: draw_heavy_rod(); break;
      case 2: draw_coil(); break;
      case 3: draw_tendon_robot(); break;
      case 4: add_tip_force(scene::Frame::fixed, log_uniform(10, 1e5) * direction()); break;
      default: draw_soft_shear();
    }
    return std::move(scene_);
  }

  scene::Scene scene() {
    planar_ = chance(0.25);
    follower_only_ = chance(1.0 / 3);
    length_mm_ = log_uniform(limits_.length_min_mm, limits_.length_max_mm);
    size_ = log_uniform(1e-3, limits_.load_max);
    draw_sections();
    if (chance(0.1)) {
      draw_moments();
    } else {
      draw_loads();
    }
    return std::move(scene_);
  }

 private:
  // The standard fixes what the engine gives, not what its distributions make of it; nor the order of a function's
  // arguments, so no two draws stand in one argument list or product, but in braces.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool chance(double probability) { return unit() < probability; }
  double uniform(double low, double high) { return low + (high - low) * unit(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, unit()); }
  int sign() { return chance(0.5) ? 1 : -1; }
  int integer(int low, int high) { return low + static_cast<int>(unit() * (high - low + 1)); }

  Vector3d direction() {
    const double angle = uniform(0, 2 * std::numbers::pi);
    if (planar_) return {std::cos(angle), std::sin(angle), 0};
    if (chance(0.1)) {
      const int axis = integer(0, 2);  // symmetric scenes
      return sign() * Vector3d::Unit(axis);
    }
    const double x = uniform(-1, 1), radius = std::sqrt(1 - x * x);
    return {x, radius * std::cos(angle), radius * std::sin(angle)};
  }
  Vector3d axis() { return planar_ ? Vector3d(sign() * Vector3d::UnitZ()) : direction(); }
  scene::Frame frame() { return follower_only_ || chance(0.4) ? scene::Frame::follower : scene::Frame::fixed; }

  // In units of EI/L^2 and EI/L.
  void add_tip_force(scene::Frame frame, const Vector3d& force) {
    scene_.loads.push_back(scene::Force{length_mm_, frame, force_unit_N_ * force});
  }
  void add_tip_moment(scene::Frame frame, const Vector3d& moment) {
    scene_.loads.push_back(scene::Moment{length_mm_, frame, force_unit_N_ * length_mm_ * moment});
  }

  scene::Stiffness& stiffness() { return std::get<scene::Stiffness>(scene_.sections[0].cross_section); }
  void add_distributed(scene::Frame frame, const Vector3d& force) {
    scene_.loads.push_back(scene::DistributedForce{0, length_mm_, frame, force_unit_N_ / length_mm_ * force});
  }

  // Bent in its stiff plane to 0.1 .. 3 times Prandtl's or the distributed load's critical one, and pushed aside.
  void draw_strip() {
    const double ratio = log_uniform(1e-4, 1);
    stiffness().bending_Nmm2[0] *= ratio;
    stiffness().torsion_Nmm2 *= chance(0.5) ? ratio : 1;
    const double critical = std::sqrt(ratio * stiffness().torsion_Nmm2 / stiffness().bending_Nmm2[1]);
    const bool distributed = chance(0.5);
    const double size = (distributed ? 12.85 : 4.0126) * critical * log_uniform(0.1, 3);
    Vector3d force = size * Vector3d::UnitY();
    force[2] = size * log_uniform(1e-8, 0.1);
    if (chance(0.3)) force[0] = size * uniform(-0.1, 0.1);
    if (distributed) add_distributed(scene::Frame::fixed, force);
    else add_tip_force(scene::Frame::fixed, force);
  }

  void draw_heavy_rod() {
    if (chance(0.3)) stiffness().bending_Nmm2[0] *= log_uniform(1, 1e3);
    stiffness().mass_per_length_kg_per_m = 1;
    const double size = log_uniform(0.3, 1000);  // q L^3/EI
    scene_.loads.push_back(scene::Gravity{1e3 * size * force_unit_N_ / length_mm_ * direction()});
  }

  // By rest curvature, or by a tendon that does not reach its coil's axis.
  void draw_coil() {
    const double turns = uniform(0.3, 20);
    const double curvature_per_mm = 2 * std::numbers::pi * turns / length_mm_;
    if (chance(0.7)) {
      const Vector3d about = chance(0.5) ? Vector3d(Vector3d::UnitZ()) : direction();
      scene_.sections[0].rest_curvature_per_mm = curvature_per_mm * about;
    } else {
      const double offset_mm = uniform(0.1, 0.7) / curvature_per_mm;
      scene_.loads.push_back(
          scene::Tendon{{0, offset_mm}, curvature_per_mm * stiffness().bending_Nmm2[0] / offset_mm, length_mm_});
    }
    add_tip_force(frame(), log_uniform(1e-2, 30) * direction());
    if (chance(0.3)) add_distributed(frame(), log_uniform(1e-2, 30) * direction());
    if (chance(0.3)) add_tip_moment(frame(), log_uniform(1e-2, 5) * direction());
  }

  void draw_tendon_robot() {
    if (chance(0.5)) make_soft(log_uniform(50, 1e6));
    if (chance(0.3)) scene_.sections[0].rest_curvature_per_mm = uniform(0, 5) / length_mm_ * direction();
    const int tendons = integer(1, 4), loads = integer(0, 3);
    for (int i = 0; i < tendons; ++i) {
      const double angle = uniform(0, 2 * std::numbers::pi), radius_mm = length_mm_ * uniform(0.005, 0.04);
      const double tension = log_uniform(0.1, 0.5 * length_mm_ / radius_mm);  // bends by half a radian over its radius
      const double to_mm = chance(0.5) ? length_mm_ : length_mm_ * uniform(0.3, 1);
      scene_.loads.push_back(
          scene::Tendon{radius_mm * Vector2d(std::cos(angle), std::sin(angle)), force_unit_N_ * tension, to_mm});
    }
    for (int i = 0; i < loads; ++i) {
      const double at_mm = chance(0.5) ? length_mm_ : length_mm_ * uniform(0.2, 1);
      const scene::Frame in = frame();
      if (chance(0.3)) {
        scene_.loads.push_back(
            scene::Moment{at_mm, in, force_unit_N_ * length_mm_ * log_uniform(0.05, 3) * direction()});
        continue;
      }
      const Vector2d offset_mm =
          chance(0.4) ? Vector2d(length_mm_ * Vector2d{uniform(-0.04, 0.04), uniform(-0.04, 0.04)}) : Vector2d(0, 0);
      scene_.loads.push_back(scene::Force{at_mm, in, force_unit_N_ * log_uniform(0.05, 10) * direction(), offset_mm});
    }
  }

  // Shear stiffness over EI/L^2.
  void make_soft(double shear) {
    stiffness().axial_N = 3 * shear * force_unit_N_;
    stiffness().shear_N = shear * force_unit_N_ * Vector2d{1, uniform(0.5, 2)};
  }

  void draw_soft_shear() {
    make_soft(log_uniform(20, 1e4));
    add_tip_force(frame(), log_uniform(0.3, 10) * direction());
    if (chance(0.7)) add_distributed(frame(), log_uniform(0.1, 10) * direction());
    if (chance(0.3)) add_tip_moment(frame(), log_uniform(0.1, 5) * direction());
  }

  // Straight aside, in a plane or anyhow; planar scenes among them.
  void draw_disturbances() {
    const int count = integer(1, 3);
    const bool one_axis = chance(0.5);
    const int axis = integer(1, 2);
    for (int i = 0; i < count; ++i) {
      const double size = sign() * log_uniform(1e-7, 0.1);
      const bool moment = chance(0.4);
      const Vector3d aside = one_axis ? Vector3d(Vector3d::Unit(moment ? 3 - axis : axis)) : direction();
      if (moment) add_tip_moment(frame(), size * aside);
      else add_tip_force(frame(), size * aside);
    }
  }

  void draw_sections() {
    const int count = chance(0.4) ? 1 : integer(2, std::max(2, limits_.sections_max));
    const double half = limits_.stiffness_decades / 2;
    const double bending = log_uniform(std::pow(10, -half), std::pow(10, half));
    const bool jumps = chance(0.2), curved = chance(0.25);
    stretches_ = chance(0.5), shears_ = chance(0.5);
    // A force of EA compresses the rod to nothing: no more than that.
    slenderness_ = log_uniform(1e-8, std::min(1e-2, 1 / size_));
    const double share_min = chance(0.1) ? 1e-4 : 0.05;
    std::vector<double> shares;
    double sum = 0, compliance = 0;
    for (int i = 0; i < count; ++i) sum += shares.emplace_back(log_uniform(share_min, 1));
    for (const double share : shares) {
      const double factor = jumps && chance(0.3) ? 1e4 : log_uniform(0.3, 3);
      scene_.sections.push_back(section(length_mm_ * share / sum, bending * factor, curved));
      compliance += share / sum / scene::stiffness_of(scene_.sections.back()).bending_Nmm2.minCoeff();
    }
    length_mm_ = scene::length_mm(scene_);
    force_unit_N_ = 1 / (compliance * length_mm_ * length_mm_);
  }

  scene::Section section(double length_mm, double bending_Nmm2, bool curved) {
    scene::Stiffness stiffness;
    const double ratio = chance(0.7) ? 1 : log_uniform(1, 1e3);
    stiffness.bending_Nmm2 =
        chance(0.5) ? Vector2d(bending_Nmm2, bending_Nmm2 * ratio) : Vector2d(bending_Nmm2 * ratio, bending_Nmm2);
    stiffness.torsion_Nmm2 = bending_Nmm2 * (chance(0.8) ? uniform(0.3, 1) : log_uniform(1e-3, 1e3));
    const double axial_N = bending_Nmm2 / (slenderness_ * length_mm_ * length_mm_);
    if (stretches_) stiffness.axial_N = axial_N;
    if (shears_) stiffness.shear_N = axial_N * Vector2d{uniform(0.2, 0.5), uniform(0.2, 0.5)};
    Vector3d rest_curvature = Vector3d::Zero();
    if (curved) {
      const double turn_rad = log_uniform(1e-2, 5);
      rest_curvature = turn_rad / length_mm_ * axis();
    }
    return {length_mm, stiffness, rest_curvature};
  }

  // Tip, anywhere, a section's end, beside the clamp, where the last load acts or a hair beside it.
  double place_mm() {
    const double drawn = unit();
    if (drawn < 0.5) return last_place_mm_ = length_mm_;
    if (drawn < 0.7) return last_place_mm_ = length_mm_ * uniform(1e-3, 1);
    if (drawn < 0.8) return last_place_mm_ = length_mm_ * log_uniform(1e-9, 1e-3);
    if (drawn < 0.9 && last_place_mm_ > 0) {
      return std::min(length_mm_, last_place_mm_ * (1 + (chance(0.5) ? 0 : 1e-13)));
    }
    double end_mm = 0;
    const int last = integer(0, static_cast<int>(scene_.sections.size()) - 1);
    for (int i = 0; i <= last; ++i) end_mm += scene_.sections[static_cast<std::size_t>(i)].length_mm;
    return last_place_mm_ = std::min(end_mm, length_mm_);
  }

  // Moments alone, together up to ten turns of the uniform rod.
  void draw_moments() {
    const int count = integer(1, 3);
    const double size = log_uniform(1e-3, ten_turns_rad) / count;
    for (int i = 0; i < count; ++i) {
      scene_.loads.push_back(scene::Moment{place_mm(), frame(), size * force_unit_N_ * length_mm_ * axis()});
    }
  }

  void draw_loads() {
    const int count = chance(0.1) ? integer(5, 12) : integer(1, 4);
    const bool unloaded = chance(0.02);
    for (int i = 0; i < count; ++i) {
      const double size = unloaded || chance(0.02) ? 0 : size_ / count * log_uniform(0.1, 1);
      scene_.loads.push_back(load(size));
    }
  }

  scene::Load load(double size) {
    const double force_N = size * force_unit_N_;
    switch (integer(0, follower_only_ ? 3 : 4)) {
      case 0: return scene::Force{place_mm(), frame(), force_N * direction()};
      case 1: return scene::Moment{place_mm(), frame(), std::sqrt(size) * force_unit_N_ * length_mm_ * axis()};
      case 2: {
        const bool whole = chance(0.5);
        const double from_mm = whole ? 0 : length_mm_ * uniform(0, 0.7);
        const double to_mm = whole ? length_mm_ : from_mm + (length_mm_ - from_mm) * uniform(0.1, 1);
        return scene::DistributedForce{from_mm, std::min(to_mm, length_mm_), frame(),
                                       force_N / length_mm_ * direction()};
      }
      case 3: {
        const Vector2d offset =
            length_mm_ * (planar_ ? Vector2d{uniform(-0.1, 0.1), 0} : Vector2d{uniform(-0.1, 0.1), uniform(-0.1, 0.1)});
        return scene::Tendon{offset, force_N, place_mm()};
      }
      default: return gravity(force_N);
    }
  }

  // The weight of a rod of 1 kg in all is force_N; some sections weigh nothing.
  scene::Gravity gravity(double force_N) {
    const double kg_per_m = 1e3 / length_mm_;
    for (scene::Section& section : scene_.sections) {
      double& mass = std::get<scene::Stiffness>(section.cross_section).mass_per_length_kg_per_m;
      if (mass == 0 && chance(0.9)) mass = kg_per_m * uniform(0.5, 1.5);
    }
    double& tip_mass = std::get<scene::Stiffness>(scene_.sections.back().cross_section).mass_per_length_kg_per_m;
    if (tip_mass == 0) tip_mass = kg_per_m;
    return {force_N * direction()};
  }

  std::mt19937_64 engine_;
  const RandomSceneLimits& limits_;
  scene::Scene scene_;
  bool planar_ = false, follower_only_ = false, stretches_ = false, shears_ = false;
  double length_mm_ = 0, size_ = 0, slenderness_ = 0, force_unit_N_ = 0, last_place_mm_ = 0;
};

}  // namespace

std::uint64_t mixed_seed(std::uint64_t index) {
  const std::uint64_t ten = index / 10, place = index % 10;
  if (place < 5) return 5 * ten + place;
  return place == 5 ? first_buckling_seed + ten : first_family_seed + 4 * ten + (place - 6);
}

namespace {

// Of a family its place among the families, of a general scene or one that buckles these.
constexpr std::size_t general = families.size(), buckling = general + 1;

std::size_t kind_index(std::uint64_t seed) {
  if (seed >= first_campaign_seed) {
    const std::uint64_t index = seed % first_campaign_seed, ten = index / 10, place = index % 10;
    return place < 5 ? general : place == 5 ? buckling : (4 * ten + place - 6) % families.size();
  }
  if (seed < first_buckling_seed) return general;
  return seed < first_family_seed ? buckling : (seed - first_family_seed) % families.size();
}

}  // namespace

std::string kind_of(std::uint64_t seed) {
  const std::size_t kind = kind_index(seed);
  return kind == general ? "general" : kind == buckling ? "buckling" : families[kind];
}

scene::Scene random_scene(std::uint64_t seed, const RandomSceneLimits& limits) {
  Drawing drawing(seed, limits);
  const std::size_t kind = kind_index(seed);
  scene::Scene scene = kind == general ? drawing.scene() : kind == buckling ? drawing.buckling() : drawing.family(kind);
  scene.title = "random scene " + std::to_string(seed);
  return scene;
}

}  // namespace studies
