// Rods for ParaView and other readers of VTK's XML files: a polyline of the centreline with what the rod has there.
// docs/paraview.md says what the arrays hold.
#pragma once

#include "scene/equilibrium.h"
#include "scene/scene.h"

#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace apps {

// Numbers of the whole rod: cell data.
using RodNumbers = std::vector<std::pair<std::string, double>>;

// A converged equilibrium of the scene as the text of a .vtu file, every double with all of its digits; an array with a
// number that is not finite is left out.
std::string to_vtu(const scene::Scene& scene, const scene::Equilibrium& result, const RodNumbers& rod_numbers = {});

// Many rods: a .vtu file each in a folder beside `path`, NAME_rods, then the collection at `path`, a .pvd file
// whose time steps are the keys. Throws studies::OutputError.
class RodCollection {
 public:
  explicit RodCollection(std::filesystem::path path) : path_(std::move(path)) {}
  void add(std::size_t step, const scene::Scene& scene, const scene::Equilibrium& result,
           const RodNumbers& rod_numbers = {});
  void write() const;

 private:
  std::filesystem::path path_;
  std::map<std::size_t, std::string> vtu_;
};

}  // namespace apps
