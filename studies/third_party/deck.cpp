#include "studies/third_party/deck.h"

#include "scene/load_visitor.h"
#include "scene/span.h"
#include "studies/third_party/end_piece.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

namespace studies {
namespace {

// Its beams are solids of 20 nodes, which lock where the volume is kept.
constexpr double most_poissons_ratio = 0.495;  // chosen, not measured
// CalculiX's clamp keeps its section from narrowing, and the first element, quadratic along the rod, spreads that over
// all of its length. So it has one more that is short: the tube's tip under a small force was 0.6 % of its way short
// with 20 elements, half as much with 40, and is 0.1 % short with this length, 0.09 % with half of it.
constexpr double clamp_element_over_diameter = 0.25;

class Deck {
 public:
  Deck(const scene::Scene& scene, std::string source, DeckFormat format, int elements)
      : scene_(scene), source_(std::move(source)), format_(format) {
    cutter_.reserve(scene_);
    const scene::Scene* const scenes[] = {&scene_};
    cutter_.cut(scenes);
    cells_ = scene::cells_per_span(scene::spans_of(scene_), elements);
    if (is_calculix()) ++cells_[0];
    check_sections();
    sum_loads();
    if (is_calculix()) take_moments();
  }

  std::string text() const {
    return heading() + mesh() + piece_.nodes_and_elements + materials() + piece_.materials + "*BOUNDARY\n1, 1, 6\n" +
           held_ + step();
  }

 private:
  bool is_calculix() const { return format_ == DeckFormat::calculix; }
  const char* program() const { return is_calculix() ? "CalculiX" : "Abaqus"; }

  [[noreturn]] void cannot(const std::string& path, const std::string& value, const std::string& rule) const {
    throw scene::SceneError(fmt::format("{}: {} = {}: a deck for {} {}", source_, path, value, program(), rule));
  }

  void check_sections() const {
    for (std::size_t i = 0; i < scene_.sections.size(); ++i) {
      const std::string path = fmt::format("rod.sections[{}]", i);
      const auto* circle = std::get_if<scene::CircularSection>(&scene_.sections[i].cross_section);
      if (!circle) cannot(path, "stiffness", "needs geometry and material");
      if (!scene_.sections[i].rest_curvature_per_mm.isZero(0))
        cannot(path + ".rest_curvature_per_mm", "not zero", "has a rod that is straight at rest");
      if (is_calculix() && circle->poissons_ratio > most_poissons_ratio) {
        cannot(path + ".material.poissons_ratio", fmt::format("{}", circle->poissons_ratio),
               fmt::format("needs one <= {}, its beams being solids", most_poissons_ratio));
      }
    }
  }

  const scene::CircularSection& circle(std::size_t section) const {
    return std::get<scene::CircularSection>(scene_.sections[section].cross_section);
  }

  // Two loads on one degree of freedom are one line: CalculiX would take the last.
  void sum_loads() {
    for (std::size_t i = 0; i < scene_.loads.size(); ++i) {
      if (scene::is_zero(scene_.loads[i])) continue;
      const std::string path = fmt::format("loads[{}]", i);
      scene::visit_load(
          scene_.loads[i],
          [&](const scene::Force& force) {
            if (!force.offset_mm.isZero(0)) cannot(path + ".offset_mm", "not zero", "has its forces on the centreline");
            at(path, force.at_mm, force.frame).head<3>() += force.value_N;
          },
          [&](const scene::Moment& moment) {
            if (is_calculix()) check_moment(path, moment);
            at(path, moment.at_mm, is_calculix() ? scene::Frame::fixed : moment.frame).tail<3>() += moment.value_Nmm;
          },
          [&](const scene::DistributedForce&) { cannot(path + ".kind", "distributed_force", "has none"); },
          [&](const scene::Gravity& gravity) { acceleration_m_per_s2_ += gravity.acceleration_m_per_s2; },
          [&](const scene::Tendon&) { cannot(path + ".kind", "tendon", "has none"); });
    }
  }

  void check_moment(const std::string& path, const scene::Moment& moment) {
    if (cutter_.nearest_cut(moment.at_mm) + 1 < cutter_.cuts_mm().size())
      cannot(path + ".at", fmt::format("{}", moment.at_mm), "has moments at the tip alone");
    if (moment.value_Nmm[0] != 0)
      cannot(path + ".value_Nmm[0]", fmt::format("{}", moment.value_Nmm[0]), "has no moment about the rod's axis");
    if (moment.frame == scene::Frame::fixed && !bends_in_plane_of(moment.value_Nmm))
      cannot(path + ".frame", "fixed", "keeps the axis of a moment in a plane alone: this scene leaves it");
  }

  bool bends_in_plane_of(const Eigen::Vector3d& moment_Nmm) const {
    const auto along = [&](const Eigen::Vector3d& axis) { return axis.cross(moment_Nmm).isZero(0); };
    const auto across = [&](const Eigen::Vector3d& value) { return value.dot(moment_Nmm) == 0; };
    return std::all_of(scene_.loads.begin(), scene_.loads.end(), [&](const scene::Load& load) {
      return scene::visit_load(
          load, [&](const scene::Force& force) { return across(force.value_N); },
          [&](const scene::Moment& moment) { return along(moment.value_Nmm); },
          [](const scene::DistributedForce&) { return true; },
          [&](const scene::Gravity& gravity) { return across(gravity.acceleration_m_per_s2); },
          [](const scene::Tendon&) { return true; });
    });
  }

  // The moment at the tip becomes the end piece's pressures. Where the rod bends in a plane of the base frame its tip
  // is held there: CalculiX's iterations let the rounding grow out of it (P8 ends at half of its load without).
  void take_moments() {
    const std::pair<bool, std::size_t> tip{false, nodes()};
    const auto found = loads_.find(tip);
    if (found == loads_.end() || found->second.tail<3>().isZero(0)) return;
    const Eigen::Vector3d moment_Nmm = found->second.tail<3>();
    found->second.tail<3>().setZero();
    piece_ =
        end_piece(circle(cutter_.sections().back()), cutter_.cuts_mm().back(), tip.second, elements() + 1, moment_Nmm);
    for (int axis = 1; axis <= 2; ++axis) {
      if (moment_Nmm[3 - axis] == 0 && bends_in_plane_of(moment_Nmm)) held_ = fmt::format("TIP, {0}, {0}\n", axis + 1);
    }
  }

  std::size_t elements() const { return static_cast<std::size_t>(std::accumulate(cells_.begin(), cells_.end(), 0)); }
  std::size_t nodes() const { return 2 * elements() + 1; }

  using Vector6d = Eigen::Matrix<double, 6, 1>;

  // Force and moment at a place, in a frame, so far.
  Vector6d& at(const std::string& path, double place_mm, scene::Frame frame) {
    const bool follows = frame == scene::Frame::follower;
    if (follows && is_calculix()) cannot(path + ".frame", "follower", "has fixed forces alone");
    std::size_t node = 1;
    for (std::size_t i = 0; i < cutter_.nearest_cut(place_mm); ++i) node += 2 * static_cast<std::size_t>(cells_[i]);
    return loads_.try_emplace({follows, node}, Vector6d::Zero()).first->second;
  }

  std::string heading() const {
    std::string title = scene_.title.substr(0, 70);
    for (char& c : title) c = static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    if (title.starts_with('*')) title.insert(0, " ");  // else a keyword
    return fmt::format("*HEADING\n{}\n** mm, N, MPa, t; {}\n", title, program());
  }

  // Of a span's element, counted from 0.
  double begin_mm(std::size_t span, double element) const {
    const double from_mm = cutter_.cuts_mm()[span], length_mm = cutter_.cuts_mm()[span + 1] - from_mm;
    const double uniform_mm = from_mm + length_mm * element / cells_[span];
    if (span > 0 || !is_calculix()) return uniform_mm;
    const double first_mm = clamp_element_over_diameter * circle(cutter_.sections()[0]).outer_diameter_mm;
    if (first_mm * cells_[0] >= length_mm) return uniform_mm;
    if (element <= 1) return first_mm * element;
    return first_mm + (length_mm - first_mm) * (element - 1) / (cells_[0] - 1);
  }

  std::string mesh() const {
    std::string nodes = "*NODE, NSET=ALL\n1, 0, 0, 0\n", elements;
    std::size_t node = 1, element = 1;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const std::string type = is_calculix() ? calculix_element(circle(cutter_.sections()[i])) : "B32";
      elements += fmt::format("*ELEMENT, TYPE={}, ELSET=SPAN{}\n", type, i + 1);
      for (int k = 1; k <= 2 * cells_[i]; ++k, ++node) {
        nodes += fmt::format("{}, {:.15g}, 0, 0\n", node + 1, begin_mm(i, 0.5 * k));
        if (k % 2 == 0) elements += fmt::format("{}, {}, {}, {}\n", element++, node - 1, node, node + 1);
      }
    }
    return nodes + elements + fmt::format("*NSET, NSET=TIP\n{}\n", node);
  }

  // PIPE: outer radius, wall; Abaqus' PIPE is a thin wall, its THICK PIPE is not. CIRC: Abaqus takes the radius,
  // CalculiX the diameters along both axes.
  std::string profile(const scene::CircularSection& section) const {
    if (is_calculix()) return calculix_profile(section);
    const double outer_mm = section.outer_diameter_mm, inner_mm = section.inner_diameter_mm;
    if (inner_mm > 0) return fmt::format("THICK PIPE\n{:.15g}, {:.15g}\n", outer_mm / 2, (outer_mm - inner_mm) / 2);
    return fmt::format("CIRC\n{:.15g}\n", outer_mm / 2);
  }

  std::string materials() const {
    std::string text;
    for (std::size_t i = 0; i < scene_.sections.size(); ++i) {
      const scene::CircularSection& section = circle(i);
      text += fmt::format("*MATERIAL, NAME=SECTION{}\n*ELASTIC\n{:.15g}, {:.15g}\n", i + 1, section.youngs_modulus_MPa,
                          section.poissons_ratio);
      if (section.density_kg_per_m3 > 0) text += fmt::format("*DENSITY\n{:.15g}\n", 1e-12 * section.density_kg_per_m3);
    }
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const std::size_t section = cutter_.sections()[i];
      text += fmt::format("*BEAM SECTION, ELSET=SPAN{}, MATERIAL=SECTION{}, SECTION={}0, 0, -1\n", i + 1, section + 1,
                          profile(circle(section)));
    }
    return text;
  }

  std::string step() const {
    std::string text = "*STEP, NLGEOM, INC=200\n*STATIC\n0.1, 1, 1e-6, 1\n";
    for (const auto& [place, load] : loads_) {
      if (load.isZero(0)) continue;
      text += place.first ? "*CLOAD, FOLLOWER\n" : "*CLOAD\n";
      for (int i = 0; i < 6; ++i) {
        if (load[i] != 0) text += fmt::format("{}, {}, {:.15g}\n", place.second, i + 1, load[i]);
      }
    }
    return text + weight() + piece_.pressures + "*NODE PRINT, NSET=TIP, FREQUENCY=1000\nU\n*END STEP\n";
  }

  std::string weight() const {
    const double size_m_per_s2 = acceleration_m_per_s2_.norm();
    if (size_m_per_s2 == 0) return "";
    const Eigen::Vector3d along = acceleration_m_per_s2_ / size_m_per_s2;
    std::string text = "*DLOAD\n";
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (circle(cutter_.sections()[i]).density_kg_per_m3 == 0) continue;
      text += fmt::format("SPAN{}, GRAV, {:.15g}, {:.15g}, {:.15g}, {:.15g}\n", i + 1, 1e3 * size_m_per_s2, along[0],
                          along[1], along[2]);
    }
    return text;
  }

  const scene::Scene& scene_;
  const std::string source_;
  const DeckFormat format_;
  scene::SpanCutter cutter_;
  std::vector<int> cells_;                                  // elements of each span
  std::map<std::pair<bool, std::size_t>, Vector6d> loads_;  // by whether they follow, and node
  Eigen::Vector3d acceleration_m_per_s2_ = Eigen::Vector3d::Zero();
  EndPiece piece_;    // CalculiX's moment at the tip
  std::string held_;  // of the tip, its lines of *BOUNDARY
};

}  // namespace

std::string deck(const scene::Scene& scene, const std::string& source, DeckFormat format, int elements) {
  return Deck(scene, source, format, elements).text();
}

}  // namespace studies
