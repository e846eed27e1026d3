// Equilibrium paths: the equilibria of a rod while one number of its scene changes, through folds and past branch
// points (scene/path.h). docs/paths.md tells what is found and how.
#pragma once

#include "fam/options.h"

#include "scene/equilibrium.h"
#include "scene/path.h"

#include <memory>

namespace fam {

// A path that has been followed. Options: the law (a coupled one), the rod model, the number of arcs or the tolerance;
// no place of a point of the path is farther than that from the exact one.
class Path {
 public:
  // From what fam::solve finds at request.from. Throws scene::SceneError on wrong input (scene::validate); numerical
  // trouble is a status of points().
  static Path follow(const scene::PathRequest& request, const Options& options = {});
  // From a point of a path of the same rod, loads and parameter, on or back: the range, the stops and the branches are
  // the new request's, the arcs those of the point. The point lies within the range.
  static Path follow_on(const scene::PathRequest& request, const Path& from, std::size_t point, bool back = false,
                        const Options& options = {});
  Path(Path&&) noexcept;
  Path& operator=(Path&&) noexcept;
  ~Path();

  const scene::Path& points() const;
  // Of a point of it: places on the rod, clamp to tip.
  std::vector<Eigen::Vector3d> centreline_mm(std::size_t point) const;
  // With stations, as fam::solve returns one; without facts of the model.
  scene::Equilibrium equilibrium(std::size_t point) const;

 private:
  struct Impl;
  explicit Path(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace fam
