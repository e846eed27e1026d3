// The walk along a path: how long its steps are, what happens in them, and where it ends.
//
// A step is predicted to second order and corrected across the tangent. It is halved where Newton's method fails, where
// it turns the tangent, the rod or the load too far, or where the number of unstable directions changes by more than
// the folds and branch points in it explain. Of those, the parameter's slope changes its sign at a fold, the
// determinant of the equations with the tangent's row at a simple branch point, and the turn across (CrossTurn) at a
// double one; each is located by secants.
#pragma once

#include "fam/path_stepper.h"

#include <functional>

namespace fam {

class PathWalk {
 public:
  struct Settings {
    PathStepper::Settings range;
    double from = 0, to = 1;
    std::vector<double> stops;
    int branches = 0;
    double largest_step = 0;  // of the parameter
    // Whether a stop, a fold or a branch point ends the walk.
    std::function<bool(const PathPlace&, scene::PathPoint::Kind)> ends_at;
    int most_points = 0;
    long long most_arcs = 0;  // marched
  };
  PathWalk(const scene::PathRequest& request, const Options& options, const Settings& settings);

  void run();
  // From a place of another walk, on or back.
  void run_from(const SavedPlace& start, bool back);

  const scene::Path& path() const { return path_; }
  const std::vector<SavedPlace>& places() const { return places_; }  // of the path's points
  PathStepper& stepper() { return stepper_; }
  // Whether steps fell below the smallest where a tendon's path has no length.
  bool tendon_collapsed() const { return path_.status == scene::PathStatus::step_too_small && collapse_is_ahead(); }

 private:
  bool collapse_is_ahead() const { return travelled_ < collapsed_at_; }
  using Kind = scene::PathPoint::Kind;
  // Something that happens in a step, so far along it.
  struct Event {
    double length;
    PathPlace place;
    Kind kind;
    int multiplicity = 0;
    std::optional<scene::PathStatus> end = std::nullopt;
    // A path that another one crosses where its own parameter turns back: a pitchfork, come to from the side. Beyond
    // lies the path's mirror image.
    bool is_arrival = false;
    std::optional<double> parameter_on_more_arcs = std::nullopt;  // of a branch point
    bool is_free_turn = false;  // where the rod may turn about its axis: the other path is the rod turned
  };
  using Test = std::function<double(const PathPlace&)>;

  void follow(PathPlace start, int branch, int multiplicity = 0);
  void start_anew(const PathPlace& place);
  void watch(const PathPlace& place);
  double watched_length(const PathPlace& from);
  std::optional<PathPlace> step_to_free_turn(const PathPlace& from);
  std::optional<PathPlace> take_step(PathPlace& from);
  bool is_beyond_point(const PathPlace& place) const;
  void go_back(PathPlace& place);
  void replace_last(const PathPlace& place);
  bool is_fit(const PathPlace& from, const PathPlace& next) const;
  std::optional<std::vector<Event>> events_between(const PathPlace& from, const PathPlace& next);
  void add_free_turn(const PathPlace& from, const PathPlace& next, std::vector<Event>& events);
  void add_turning_points(const PathPlace& from, const PathPlace& next, std::vector<Event>& events);
  void add_closure(const PathPlace& from, const PathPlace& next, std::vector<Event>& events);
  bool hold_on_more_arcs(PathPlace& from, std::vector<Event>& events);
  std::optional<std::vector<Event>> events_anew(const PathPlace& from);
  bool stops_are_accurate(PathPlace& from, const std::vector<Event>& events);
  bool relocate(PathPlace& start);
  Event crossing(const PathPlace& from, const Event& near);
  // Between two places of a step: so far along it.
  struct Stretch {
    PathPlace from, next;
    double start, end;
  };
  Stretch whole(const PathPlace& from, const PathPlace& next) const { return {from, next, 0, length_}; }
  void add_stops(const PathPlace& from, const PathPlace& next, std::vector<Event>& events);
  void add_stops(const Stretch& within, std::vector<Event>& events);
  std::optional<Event> located(const Stretch& within, Kind kind, const Test& test);
  Eigen::Matrix<double, 13, 1> away_from_start(const PathPlace& place) const;
  bool is_first_again(const PathPlace& place);
  bool emit(const PathPlace& from, const Event& event, int branch);
  void add(const PathPlace& place, Kind kind, int branch, int multiplicity = 0);
  void end(scene::PathStatus status, const std::string& message = {});

  Settings settings_;
  bool is_turn_ = false;
  PathStepper stepper_;
  scene::Path path_;
  std::vector<SavedPlace> places_;
  std::vector<double> stops_;
  struct Fork {
    SavedPlace at;
    int multiplicity;
    SavedPlace before;  // where the step began in which it was located, and that step
    double length;
  };
  std::vector<Fork> forks_;
  PathPlace first_;  // of the branch that is followed
  // What there was before each of its steps.
  struct Before {
    std::size_t points, stops, forks;
    double travelled;
  };
  std::vector<Before> steps_taken_;
  PathChange curvature_;
  static constexpr double located_to = 1e-12;  // of the parameter
  double located_to_ = located_to;
  double length_ = 0;
  double travelled_ = 0;  // on this branch, as are the rest
  scene::BranchWatch watch_;
  int watched_places_ = 0;
  double collapsed_at_ = 0;  // how far the last step led that failed by a tendon without length
  bool ended_ = false;
};

}  // namespace fam
