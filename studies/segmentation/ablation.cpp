#include "studies/segmentation/ablation.h"

#include <fmt/format.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_min.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace studies {
namespace {

const std::vector<int> sweep_arcs = {1, 2, 3, 4, 6, 8, 12, 16, 20, 30, 50, 100, 200, 500, 1000, 2000, 5000};

struct MarchResult {
  Eigen::Vector2d tip_mm;
  double drift;                                      // of |F|, relative
  std::vector<double> angle_errors_rad, angles_rad;  // tip to clamp
};

// The wrench carried through given angles in double and without cancellation.
struct Shadow {
  double fx, fy, m;

  void carry(double angle, double arc_mm, bool straight) {
    const fam::ScrewCoefficients k = fam::screw_coefficients(angle * angle);
    const double sine = k.A * angle, cosine = 1 - k.B * angle * angle, x = fx;
    if (!straight) {
      fx = cosine * x - sine * fy;
      fy = sine * x + cosine * fy;
    }
    m += arc_mm * (k.A * fy - k.B * angle * fx);
  }
};

// The tip from each arc's end in its own frame, clamp to tip.
template <class T>
Eigen::Vector2d summed_up(const std::vector<T>& angle, const std::vector<T>& px, const std::vector<T>& py) {
  T x = 0, y = 0, turned = 0;
  for (std::size_t i = 0; i < angle.size(); ++i) {
    const T c = static_cast<T>(std::cos(static_cast<long double>(turned)));
    const T s = static_cast<T>(std::sin(static_cast<long double>(turned)));
    x += c * px[i] - s * py[i];
    y += s * px[i] + c * py[i];
    turned += angle[i];
  }
  return {static_cast<double>(x), static_cast<double>(y)};
}

// The same from the angles alone, tip to clamp, in double and without cancellation.
Eigen::Vector2d soundly_summed_up(const std::vector<double>& tip_to_clamp, double arc_mm) {
  const std::vector<double> angles(tip_to_clamp.rbegin(), tip_to_clamp.rend());
  std::vector<double> px, py;
  for (const double angle : angles) {
    const fam::ScrewCoefficients k = fam::screw_coefficients(angle * angle);
    px.push_back(arc_mm * k.A);
    py.push_back(arc_mm * k.B * angle);
  }
  return summed_up<double>(angles, px, py);
}

// From tip to clamp, then the pose from clamp to tip, all in T.
template <class T>
MarchResult march(const PlanarCantilever& rod, const Weakness& weakness, int arcs) {
  static const Weakness sound;
  const double arc_mm = rod.length_mm / arcs, bending_Nmm2 = rod.bending_stiffness_Nmm2;
  const T h = static_cast<T>(arc_mm), compliance = h / static_cast<T>(bending_Nmm2);
  Shadow shadow{rod.tip_force_N[0], rod.tip_force_N[1], rod.tip_moment_Nmm};
  T fx = static_cast<T>(shadow.fx), fy = static_cast<T>(shadow.fy), m = static_cast<T>(shadow.m);
  MarchResult result;
  std::vector<T> angle(static_cast<std::size_t>(arcs)), px(angle.size()), py(angle.size());
  for (std::size_t i = angle.size(); i-- > 0;) {
    const PlanarArc<T> arc{m * compliance, fx * h * compliance, fy * h * compliance, weakness};
    const T t = angle[i] = arc.angle(static_cast<T>(arcs));
    const PlanarArc<double> exactly{
        static_cast<double>(m) * rod.length_mm / arcs / bending_Nmm2,
        static_cast<double>(fx) * rod.length_mm / arcs * rod.length_mm / arcs / bending_Nmm2,
        static_cast<double>(fy) * rod.length_mm / arcs * rod.length_mm / arcs / bending_Nmm2, sound};
    result.angle_errors_rad.push_back(static_cast<double>(t) - exactly.angle(arcs));
    result.angles_rad.push_back(static_cast<double>(t));
    const auto k = arc.forms(t);
    px[i] = h * k.A;
    py[i] = h * k.B * t;
    const T nx = weakness.straight_to_next ? fx : k.cosine * fx - k.sine * fy;
    const T ny = weakness.straight_to_next ? fy : k.sine * fx + k.cosine * fy;
    fx = nx;
    fy = ny;
    m += px[i] * fy - py[i] * fx;
    shadow.carry(static_cast<double>(t), rod.length_mm / arcs, weakness.straight_to_next);
  }
  result.tip_mm = summed_up<T>(angle, px, py);
  result.drift = static_cast<double>(m) / shadow.m - 1;
  return result;
}

MarchResult march_in(const PlanarCantilever& rod, const Weakness& weakness, int arcs) {
  return weakness.single_precision ? march<float>(rod, weakness, arcs) : march<double>(rod, weakness, arcs);
}

std::vector<AblationRow> variants() {
  const Search golden = Search::golden, brent = Search::brent, bisection = Search::bisection;
  std::vector<AblationRow> rows = {
      {"sound", "sound: double, root of dPi/dtheta", {}, {}},
      {"alone", "single precision", {.single_precision = true}, {}},
      {"alone", "unsafe forms", {.unsafe_forms = true}, {}},
      {"alone", "golden section", {.search = golden}, {}},
      {"alone", "GSL Brent", {.search = brent}, {}},
      {"alone", "radius unknown, golden section", {.search = golden, .radius_unknown = true}, {}},
      {"alone", "force not turned in the arc", {.straight_in_arc = true}, {}},
      {"alone", "force not turned to the next arc", {.straight_to_next = true}, {}},
      {"combined", "single, unsafe", {.single_precision = true, .unsafe_forms = true}, {}},
      {"combined", "golden, expanded Pi", {.expanded = true, .search = golden}, {}},
      {"combined", "single, golden", {.single_precision = true, .search = golden}, {}},
      {"combined", "single, GSL Brent", {.single_precision = true, .search = brent}, {}},
      {"combined", "single, unsafe, golden", {.single_precision = true, .unsafe_forms = true, .search = golden}, {}},
      {"combined", "single, golden, expanded Pi", {.single_precision = true, .expanded = true, .search = golden}, {}},
      {"combined",
       "single, golden, radius unknown",
       {.single_precision = true, .search = golden, .radius_unknown = true},
       {}},
      {"combined",
       "single, unsafe, golden, radius unknown",
       {.single_precision = true, .unsafe_forms = true, .search = golden, .radius_unknown = true},
       {}},
      {"combined",
       "single, unsafe, golden 1e-03",
       {.single_precision = true, .unsafe_forms = true, .search = golden, .tolerance = 1e-3},
       {}},
      {"combined",
       "single, unsafe, golden 1e-03, force not turned to the next arc",
       {.single_precision = true, .unsafe_forms = true, .search = golden, .tolerance = 1e-3, .straight_to_next = true},
       {}}};
  const auto alone_and_combined = static_cast<long>(rows.size());
  for (const double tolerance : {1e-2, 3e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10}) {
    const std::string text = fmt::format("{:.0e}", tolerance);
    rows.push_back({"tolerance", "golden section " + text, {.search = golden, .tolerance = tolerance}, {}});
    rows.push_back({"tolerance", "Brent " + text, {.search = brent, .tolerance = tolerance}, {}});
    rows.push_back({"tolerance", "bisection " + text, {.search = bisection, .tolerance = tolerance}, {}});
    rows.push_back({"tolerance", "secant root " + text, {.tolerance = tolerance}, {}});
    rows.push_back({"tolerance",
                    "radius, golden " + text,
                    {.search = golden, .tolerance = tolerance, .radius_unknown = true},
                    {}});
  }
  std::stable_sort(rows.begin() + alone_and_combined, rows.end(),
                   [](const AblationRow& a, const AblationRow& b) { return a.name[0] < b.name[0]; });
  return rows;
}

Cancellation cancellation(int arcs) {
  const double t = 2.3 / arcs, exact = fam::screw_coefficients(t * t).B;
  static const Weakness unsafe{.unsafe_forms = true};
  const double in_single = PlanarArc<float>{0, 0, 0, unsafe}.forms(static_cast<float>(t)).B;
  const double in_double = PlanarArc<double>{0, 0, 0, unsafe}.forms(t).B;
  return {arcs, t, std::abs(in_single / exact - 1), std::abs(in_double / exact - 1)};
}

// What all variants are judged against.
struct Truth {
  PlanarCantilever rod;
  Eigen::Vector2d exact_mm, fe_mm;
};

AblationPoint weakened_point(const Truth& truth, const Weakness& weakness, int arcs) {
  const MarchResult result = march_in(truth.rod, weakness, arcs);
  AblationPoint point{arcs,         (result.tip_mm - truth.exact_mm).norm(), 0, 0, 0, 0,
                      result.drift, (result.tip_mm - truth.fe_mm).norm()};
  for (const double error : result.angle_errors_rad) point.bias_rad += error;
  for (std::size_t i = 0; i < result.angles_rad.size(); ++i) {
    const double error = result.angle_errors_rad[i];
    point.scatter_rad += std::pow(error - point.bias_rad / arcs, 2);
    point.largest_relative = std::max(point.largest_relative, std::abs(error / result.angles_rad[i]));
  }
  point.scatter_rad = std::sqrt(point.scatter_rad);
  point.sums_mm = (result.tip_mm - soundly_summed_up(result.angles_rad, truth.rod.length_mm / arcs)).norm();
  return point;
}

AblationRow swept(AblationRow row, const Truth& truth) {
  for (const int arcs : sweep_arcs) row.points.push_back(weakened_point(truth, row.weakness, arcs));
  return row;
}

void count(Census& census, double tolerance, const Trend& t) {
  ++census.curves;
  census.rise += t.rises();
  census.under_3_mm += t.under_3_mm();
  census.minimum_near_12 += t.minimum_near_12();
  if (!(t.rises() && t.under_3_mm() && t.minimum_near_12())) return;
  if (census.all_three++ == 0) census.smallest_all = tolerance;
  census.largest_all = tolerance;
}

std::vector<Census> take_censuses(const Truth& truth) {
  constexpr int curves = 41;
  std::vector<Census> censuses;
  for (const auto& [search, name] : {std::pair{Search::golden, "golden section"}, {Search::bisection, "bisection"}}) {
    Census exact{name, "exact", 0, 0, 0, 0, 0, 0, 0}, fe{name, "fe", 0, 0, 0, 0, 0, 0, 0};
    for (int i = 0; i < curves; ++i) {
      const double tolerance = std::pow(10, -4 + 2. * i / (curves - 1));
      const AblationRow row = swept({"", "", {.search = search, .tolerance = tolerance}, {}}, truth);
      count(exact, tolerance, trend(row, &AblationPoint::error_mm));
      count(fe, tolerance, trend(row, &AblationPoint::fe_mm));
    }
    censuses.push_back(exact);
    censuses.push_back(fe);
  }
  return censuses;
}

}  // namespace

double brent_minimum(const std::function<double(double)>& f, double low, double high, double tolerance) {
  static const bool quiet = gsl_set_error_handler_off() != nullptr;
  (void)quiet;
  gsl_function function{[](double x, void* p) { return (*static_cast<const std::function<double(double)>*>(p))(x); },
                        const_cast<std::function<double(double)>*>(&f)};
  const std::unique_ptr<gsl_min_fminimizer, void (*)(gsl_min_fminimizer*)> state(
      gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent), gsl_min_fminimizer_free);
  if (gsl_min_fminimizer_set(state.get(), &function, (low + high) / 2, low, high) != GSL_SUCCESS) {
    return std::numeric_limits<double>::quiet_NaN();  // the straight arc is not below both ends
  }
  for (int i = 0; i < 100; ++i) {
    if (gsl_min_fminimizer_iterate(state.get()) != GSL_SUCCESS) break;
    const double a = gsl_min_fminimizer_x_lower(state.get()), b = gsl_min_fminimizer_x_upper(state.get());
    if (tolerance > 0 && gsl_min_test_interval(a, b, tolerance, 0) == GSL_SUCCESS) break;
  }
  return gsl_min_fminimizer_x_minimum(state.get());
}

Eigen::Vector2d weakened_tip_mm(const PlanarCantilever& rod, const Weakness& weakness, int arcs) {
  return march_in(rod, weakness, arcs).tip_mm;
}

const AblationRow& AblationData::row(const std::string& name) const {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const AblationRow& r) { return r.name == name; });
  if (found == rows.end()) throw std::logic_error("no ablation " + name);
  return *found;
}

const AblationPoint& AblationData::point(const std::string& name, int arcs) const {
  const std::vector<AblationPoint>& points = row(name).points;
  return *std::find_if(points.begin(), points.end(), [&](const AblationPoint& p) { return p.arcs == arcs; });
}

bool stops_at_a_bracket(const Weakness& w) {
  return w.tolerance > 0 && !w.radius_unknown && (w.search == Search::golden || w.search == Search::bisection);
}

// A stiffness from a diameter and a modulus is rounded to ten digits: weak arithmetic is chaotic, and its results would
// hang on the last bits.
AblationData run_ablation(const PlanarCantilever& given, const Eigen::Vector2d& fe_tip_mm) {
  PlanarCantilever rod = given;
  rod.bending_stiffness_Nmm2 = std::stod(fmt::format("{:.10g}", given.bending_stiffness_Nmm2));
  const exact_reference::PlanarPose tip = exact_reference::Elastica::with_follower_load(rod).tip();
  const Truth truth{rod, tip.position_B_mm, fe_tip_mm};
  AblationData data{rod.length_mm, std::abs(tip.angle_rad), take_censuses(truth), variants(), {}};
  for (AblationRow& row : data.rows) row = swept(row, truth);
  for (const int arcs : {1, 12, 100, 500, 1000, 5000}) data.cancellations.push_back(cancellation(arcs));
  return data;
}

Trend trend(const AblationRow& row, double AblationPoint::*error) {
  std::vector<ArcError> curve;
  for (const AblationPoint& p : row.points) curve.push_back({p.arcs, p.*error});
  return trend(curve);
}

}  // namespace studies
