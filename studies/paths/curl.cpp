// The heavy curl: one path in the rest curvature for each weight.
#include "exact_reference/path.h"
#include "fam/path.h"
#include "scene/path_file.h"
#include "studies/paths/data.h"
#include "studies/scenes/cases.h"

namespace studies {
namespace {

using scene::PathPoint;

constexpr double weights[] = {10, 11, 12, 14, 20, 28, 40, 56, 80, 113, 160};  // w L^3/EI
constexpr double largest_curvature = 15;                                      // times L
constexpr std::size_t judged_every = 4;                                       // by the exact reference

// The parameter of the first point of a kind on a branch, its start left out.
std::optional<double> first_critical(const scene::Path& path, int branch) {
  for (const PathPoint& point : path.points) {
    if (point.branch == branch && point.kind == PathPoint::Kind::branch) return point.parameter;
  }
  return std::nullopt;
}

scene::PathRequest curl_request(const scene::PathRequest& from, double weight) {
  scene::PathRequest request = from;
  const double length_mm = scene::length_mm(request.scene);
  scene::Section& section = request.scene.sections.front();
  const double bending_Nmm2 = std::get<scene::Stiffness>(section.cross_section).bending_Nmm2[0];
  section.rest_curvature_per_mm = {0, 0, 1 / length_mm};
  known_load<scene::DistributedForce>(request.scene.loads.front())->value_N_per_mm = {
      weight * bending_Nmm2 / (length_mm * length_mm * length_mm), 0, 0};
  request.to = largest_curvature;
  request.branches = 1;
  return request;
}

}  // namespace

std::vector<CurlPoint> curl_boundary(const std::filesystem::path& cases) {
  const scene::PathRequest request = scene::read_path_file((cases / "paths" / "curl.json").string());
  const double length_mm = scene::length_mm(request.scene);
  fam::Options options;
  options.tolerance_mm = 1e-6 * length_mm;
  std::vector<CurlPoint> points;
  for (const double weight : weights) {
    const scene::PathRequest of_weight = curl_request(request, weight);
    const fam::Path path = fam::Path::follow(of_weight, options);
    CurlPoint point;
    point.weight = weight;
    point.leaves = first_critical(path.points(), 0);
    point.returns = first_critical(path.points(), 1);
    if (points.size() % judged_every == 0) {
      scene::PathRequest plane_only = of_weight;
      plane_only.branches = 0;
      point.leaves_exact = first_critical(exact_reference::follow(plane_only), 0);
    }
    points.push_back(point);
  }
  return points;
}

}  // namespace studies
