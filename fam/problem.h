// A scene as it is solved: its spans, the way of its loads, and the model chosen.
#pragma once

#include "fam/loaded_rod.h"
#include "fam/model_choice.h"

#include "scene/scene.h"

namespace fam {

// Throws scene::SceneError.
void validate(const Options& options);

class Problem {
 public:
  Problem() = default;
  Problem(const Problem&) = delete;  // views into its own lists
  Problem& operator=(const Problem&) = delete;

  // Memory for this scene, whatever its loads become and wherever they move.
  void reserve(const scene::Scene& scene, const Room& room);
  // The loads grow together from none.
  void set(const scene::Scene& scene, const Options& options);
  // They go on from those of another problem with the same sections and kinds of load.
  void set(const scene::Scene& scene, const Options& options, const Problem& before);

  // Solved in space, wherever its loads lie.
  void leave_plane();

  const scene::Scene& scene() const { return scene_; }
  const Options& options() const { return options_; }
  // Whether the path is followed that loads which cannot grow on take.
  bool follows_path() const { return options_.locate_limit || options_.after_snap; }
  const Choice& choice() const { return choice_; }
  double tolerance_mm() const { return tolerance_mm_; }
  double length_mm() const { return given_.to.back().end_mm; }

  // Under the full loads: as the scene has them; as they are solved, but for a plane's rotation; each one's section.
  std::span<const scene::Span> scene_spans() const { return given_.to; }
  std::span<const scene::Span> spans() const {
    return choice_.round ? std::span<const scene::Span>(solved_.to) : scene_spans();
  }
  std::span<const std::size_t> section_of_span() const { return cutter_.sections(); }
  // Under the loads that the way starts from.
  std::span<const scene::Span> spans_before() const { return given_.from; }
  // As they are solved.
  const LoadWay& way() const { return way_; }

 private:
  struct Spans {
    scene::Reused<scene::Span> from, to, bounds;
  };
  void take(const scene::Scene& scene, const Options& options);
  void set_way(bool from_no_load);

  scene::Scene scene_;
  Options options_;
  double tolerance_mm_ = 0;
  scene::SpanCutter cutter_;
  Spans given_, solved_;
  Choice choice_;
  LoadWay way_;
};

// Why the law cannot solve it (published); empty where it can.
std::string refusal(const Problem& problem);

// The larger of each load and rest curvature of two rods with the same cuts.
void set_larger(std::span<const scene::Span> a, std::span<const scene::Span> b, scene::Reused<scene::Span>& larger);

}  // namespace fam
