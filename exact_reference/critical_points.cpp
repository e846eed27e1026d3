#include "exact_reference/critical_points.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace exact_reference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Kind = scene::PathPoint::Kind;

// Chosen, not measured: the polynomial's error falls as the sixth power, and round-off rises as the inverse.
constexpr double widest_stencil = 0.02;
constexpr double closest_events = 1e-5;  // nearer ones count as one double point
// At a point between samples. Where two branches all but meet and the samples lie on both it is the square of the gap;
// elsewhere round-off, 1e-12 at most in what was measured.
constexpr double largest_residual = 1e-9;

// A branch whose parameter does not change at all: where one value of it lets equilibria turn freely.
constexpr double no_slope = 1e-8;

struct Placed {
  double s = 0;
  Solution at;
};

struct Events {
  bool fold = false, branch = false;
  bool turned_in_plane = false;     // without the determinant of all motions
  std::optional<int> index_change;  // size of

  int count() const { return std::max<int>(fold + branch, index_change.value_or(turned_in_plane ? 2 : 0)); }
  bool is_simple() const { return fold + branch == 1 && index_change.value_or(1) == 1; }
  // Also a pitchfork, met on the branch that is its handle's mirror: the parameter turns back there.
  bool is_fold_and_branch() const { return fold && branch && index_change.value_or(0) % 2 == 0; }
  bool may_be_double() const { return !fold && !branch && index_change.value_or(turned_in_plane ? 2 : 0) == 2; }
};

Events events_between(const Continuation& path, const Solution& a, const Solution& b) {
  Events events;
  const bool stands_still = std::max(std::abs(a.slope()), std::abs(b.slope())) < no_slope * path.parameter_scale();
  events.fold = !stands_still && (a.slope() < 0) != (b.slope() < 0);
  events.branch = a.negative != b.negative;
  if (a.index && b.index) events.index_change = std::abs(*a.index - *b.index);
  const bool straight = a.negative_in_xy && b.negative_in_xy;
  events.turned_in_plane = straight && !events.branch && *a.negative_in_xy != *b.negative_in_xy;
  return events;
}

// The polynomial through samples, by Lagrange's formula.
template <class Value>
Value through(const std::vector<double>& s, const std::vector<Value>& values, double at) {
  Value sum = 0 * values[0];
  for (std::size_t i = 0; i < s.size(); ++i) {
    double weight = 1;
    for (std::size_t j = 0; j < s.size(); ++j) {
      if (j != i) weight *= (at - s[j]) / (s[i] - s[j]);
    }
    sum += weight * values[i];
  }
  return sum;
}

// Empty: the ends have the same sign.
std::optional<double> zero_through(const std::vector<double>& s, const std::vector<double>& values, double a,
                                   double b) {
  const bool start = through(s, values, a) < 0;
  if (start == (through(s, values, b) < 0)) return std::nullopt;
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i) {
    const double middle = (a + b) / 2;
    ((through(s, values, middle) < 0) == start ? a : b) = middle;
  }
  return (a + b) / 2;
}

// Where the slope of the cubic that has the ends' parameters and slopes is opposite to theirs: two folds may lie
// between. A share of the way.
std::optional<double> hidden_folds(const Placed& a, const Placed& b) {
  const double start = a.at.slope(), end = b.at.slope();
  const double chord = (b.at.parameter() - a.at.parameter()) / (b.s - a.s);
  const double linear = 6 * chord - 4 * start - 2 * end, square = 3 * (start + end) - 6 * chord;
  const double share = -linear / (2 * square);  // the slope at it: start + linear share + square share^2
  if (!(share > 0 && share < 1) || (start + linear * share / 2) * start >= 0) return std::nullopt;
  return share;
}

class Search {
 public:
  explicit Search(Continuation& path) : path_(path) {}

  bool between(const Placed& a, const Placed& b) {
    const Events events = events_between(path_, a.at, b.at);
    const double width = b.s - a.s;
    if (events.count() == 0) {
      const std::optional<double> share = hidden_folds(a, b);
      if (!share) return true;
      const double s = a.s + *share * width;
      const std::optional<Solution> middle = path_.at(s, (1 - *share) * a.at.x + *share * b.at.x);
      if (!middle) return false;
      const bool folds = (middle->slope() < 0) != (a.at.slope() < 0);
      return !folds || (between(a, {s, *middle}) && between({s, *middle}, b));
    }
    const bool narrow = width <= widest_stencil;
    if (narrow && (events.is_simple() || events.is_fold_and_branch())) {
      return locate(a, b, {.fold = events.fold, .branch = events.branch, .multiplicity = 1});
    }
    const bool stays_double = path_.is_straight(a.at.x) || width < closest_events;
    if (narrow && events.may_be_double() && stays_double)
      return locate(a, b, {.fold = false, .branch = true, .multiplicity = 2});
    if (width < closest_events / 10) return false;
    // Not halves: symmetric paths have their critical points in the middle.
    for (const double share : {0.53, 0.41, 0.62}) {
      const double s = a.s + share * width;
      const std::optional<Solution> middle = path_.at(s, (1 - share) * a.at.x + share * b.at.x);
      if (middle) return between(a, {s, *middle}) && between({s, *middle}, b);
    }
    return false;
  }

  std::vector<CriticalPoint> found;

 private:
  struct Wanted {
    bool fold, branch;
    int multiplicity;
  };
  struct Samples {
    std::vector<double> s, slopes, singularities;
    std::vector<VectorXd> x, tangents;
  };

  // At Chebyshev's points. The singularities: of the matrix along these vectors.
  std::optional<Samples> sample(const Placed& a, const Placed& b, const Continuation::SingularVectors* vectors) {
    constexpr int count = 6;
    Samples samples;
    MatrixXd first;
    for (int i = 0; i < count; ++i) {
      const double share = (1 - std::cos((i + 0.5) * std::numbers::pi / count)) / 2;
      const double s = a.s + share * (b.s - a.s);
      const std::optional<Solution> at = path_.at(s, (1 - share) * a.at.x + share * b.at.x);
      if (!at) return std::nullopt;
      samples.s.push_back(s);
      samples.x.push_back(at->x);
      samples.tangents.push_back(at->tangent);
      samples.slopes.push_back(at->slope());
      if (vectors == nullptr) continue;
      const MatrixXd G = path_.singularity(at->x, *vectors).G;
      if (i == 0) first = G;
      samples.singularities.push_back(G.cwiseProduct(first).sum());
    }
    return samples;
  }

  bool locate(const Placed& a, const Placed& b, const Wanted& wanted) {
    std::optional<Continuation::SingularVectors> vectors;
    if (wanted.branch) vectors = path_.smallest_vectors(b.at, wanted.multiplicity);
    const std::optional<Samples> samples = sample(a, b, vectors ? &*vectors : nullptr);
    if (!samples) return false;
    // The ends' signs tell that it lies between them; the polynomial may have it a little beyond.
    const double beyond = 0.05 * (b.s - a.s);
    std::optional<double> fold, branch;
    if (wanted.fold) fold = zero_through(samples->s, samples->slopes, a.s - beyond, b.s + beyond);
    if (wanted.branch) branch = zero_through(samples->s, samples->singularities, a.s - beyond, b.s + beyond);
    if ((wanted.fold && !fold) || (wanted.branch && !branch)) return false;
    const bool together = fold && branch && std::abs(*fold - *branch) < closest_events;
    const std::size_t before = found.size();
    if (fold && !together) note(Kind::fold, *fold, 1, *samples);
    if (branch) {
      note(Kind::branch, *branch, wanted.multiplicity, *samples);
      found.back().null_vectors = path_.singularity(found.back().x, *vectors).null_vectors;
    }
    if (found.size() == before + 2 && *fold > *branch) std::swap(found[before], found[before + 1]);
    for (std::size_t i = before; i < found.size(); ++i) {
      if (!(path_.largest_residual(found[i].x) < largest_residual)) return false;
    }
    if (a.at.index && b.at.index) {
      for (std::size_t i = before; i < found.size(); ++i) found[i].index = std::min(*a.at.index, *b.at.index);
    }
    return true;
  }

  void note(Kind kind, double s, int multiplicity, const Samples& samples) {
    CriticalPoint& point = found.emplace_back();
    point.kind = kind;
    point.multiplicity = multiplicity;
    point.s = s;
    point.x = through(samples.s, samples.x, s);
    point.tangent = through(samples.s, samples.tangents, s);
  }

  Continuation& path_;
};

}  // namespace

std::optional<std::vector<CriticalPoint>> critical_points(Continuation& path, const Solution& end, double s) {
  Search search(path);
  if (!search.between({0, path.base()}, {s, end})) return std::nullopt;
  return std::move(search.found);
}

}  // namespace exact_reference
