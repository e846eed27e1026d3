// Any bytes as a scene file and as a path file: they are a scene, a path request, or a SceneError of one line, and
// nothing else. A scene has spans that cover the rod, and is written as a file that reads back the same. Run by
// libFuzzer, and over the corpus by replay_corpus.cpp.
#include "scene/path_file.h"
#include "scene/scene_file.h"
#include "scene/span.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sstream>

namespace {

void require(bool holds, const char* what, const std::string& detail = "") {
  if (holds) return;
  std::fprintf(stderr, "broken: %s %s\n", what, detail.c_str());
  std::abort();
}

bool same(const scene::Stiffness& a, const scene::Stiffness& b) {
  return a.torsion_Nmm2 == b.torsion_Nmm2 && a.bending_Nmm2 == b.bending_Nmm2 && a.axial_N == b.axial_N &&
         a.shear_N == b.shear_N && a.mass_per_length_kg_per_m == b.mass_per_length_kg_per_m;
}

bool same(const scene::CircularSection& a, const scene::CircularSection& b) {
  return a.outer_diameter_mm == b.outer_diameter_mm && a.inner_diameter_mm == b.inner_diameter_mm &&
         a.youngs_modulus_MPa == b.youngs_modulus_MPa && a.poissons_ratio == b.poissons_ratio &&
         a.density_kg_per_m3 == b.density_kg_per_m3;
}

bool same(const scene::Force& a, const scene::Force& b) {
  return a.at_mm == b.at_mm && a.frame == b.frame && a.value_N == b.value_N;
}

bool same(const scene::Moment& a, const scene::Moment& b) {
  return a.at_mm == b.at_mm && a.frame == b.frame && a.value_Nmm == b.value_Nmm;
}

bool same(const scene::DistributedForce& a, const scene::DistributedForce& b) {
  return a.from_mm == b.from_mm && a.to_mm == b.to_mm && a.frame == b.frame && a.value_N_per_mm == b.value_N_per_mm;
}

bool same(const scene::Gravity& a, const scene::Gravity& b) {
  return a.acceleration_m_per_s2 == b.acceleration_m_per_s2;
}

bool same(const scene::Tendon& a, const scene::Tendon& b) {
  return a.offset_mm == b.offset_mm && a.tension_N == b.tension_N && a.to_mm == b.to_mm;
}

template <class... Kinds>
bool same(const std::variant<Kinds...>& a, const std::variant<Kinds...>& b) {
  return a.index() == b.index() && std::visit(
                                       [&](const auto& of_a) {
                                         using Kind = std::decay_t<decltype(of_a)>;
                                         return same(of_a, std::get<Kind>(b));
                                       },
                                       a);
}

bool same(const scene::Section& a, const scene::Section& b) {
  return a.length_mm == b.length_mm && a.rest_curvature_per_mm == b.rest_curvature_per_mm &&
         same(a.cross_section, b.cross_section);
}

bool same(const scene::Scene& a, const scene::Scene& b) {
  if (a.title != b.title || a.sections.size() != b.sections.size() || a.loads.size() != b.loads.size()) return false;
  for (std::size_t i = 0; i < a.sections.size(); ++i) {
    if (!same(a.sections[i], b.sections[i])) return false;
  }
  for (std::size_t i = 0; i < a.loads.size(); ++i) {
    if (!same(a.loads[i], b.loads[i])) return false;
  }
  return true;
}

void check_spans(const scene::Scene& scene) {
  const std::vector<scene::Span> spans = scene::spans_of(scene);
  require(!spans.empty() && spans.front().start_mm == 0, "the spans begin at the clamp");
  for (std::size_t i = 0; i < spans.size(); ++i) {
    require(spans[i].start_mm < spans[i].end_mm, "a span has a length");
    require(i == 0 || spans[i].start_mm == spans[i - 1].end_mm, "a span begins where the last one ends");
  }
  const double length = scene::length_mm(scene);
  require(std::abs(spans.back().end_mm - length) <= 2 * scene::same_place_relative * length,
          "the spans end at the tip");
  int cells = 0;
  for (const int count : scene::cells_per_span(spans, 12)) {
    require(count >= 1, "a span has a cell");
    cells += count;
  }
  require(cells == std::max(12, static_cast<int>(spans.size())), "as many cells as asked for");
}

void check_error(const std::string& what) {
  require(what.rfind("fuzz: ", 0) == 0, "an error names the file:", what);
  require(what.size() < 1000, "an error is short:", what);
  for (const char c : what) require(c >= ' ' && c <= '~', "an error is one printable line:", what);
}

void check_scene(const scene::Scene& scene) {
  scene::validate(scene);
  check_spans(scene);
  const std::string text = scene::write_scene(scene);
  std::istringstream again(text);
  require(same(scene::read_scene(again, "written"), scene), "what is written reads back the same:", text);
}

// Read by `read`, seen by `check`.
template <class Read, class Check>
void fuzz(const std::string& text, const Read& read, const Check& check) {
  std::istringstream input(text);
  try {
    check(read(input, "fuzz"));
  } catch (const scene::SceneError& error) {
    check_error(error.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz(text, scene::read_scene, check_scene);
  fuzz(text, scene::read_path, [](const scene::PathRequest& request) {
    scene::validate(request);
    for (const double end : {request.from, request.to}) scene::scene_at(request, end);
  });
  return 0;
}
