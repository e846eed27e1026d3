#include "scene/load_visitor.h"
#include "scene/path.h"
#include "scene/text.h"

#include <algorithm>
#include <cmath>

namespace scene {
namespace {

// Checks one request; each check names the JSON path of the value that it looks at.
class PathChecker {
 public:
  PathChecker(const PathRequest& request, const std::string& source) : request_(request), source_(source) {}

  void check() const {
    validate(request_.scene, source_, "scene");
    check_parameter();
    finite("from", request_.from);
    finite("to", request_.to);
    require(request_.from != request_.to, "to", request_.to, "must differ from `from`");
    require(std::isfinite(request_.to - request_.from), "to", request_.to, "the range must be finite");
    const auto [low, high] = std::minmax(request_.from, request_.to);
    if (pulls_tendons())
      require(low >= 0, request_.from < request_.to ? "from" : "to", low, "must be >= 0: a tendon's tension");
    for (std::size_t i = 0; i < request_.stop_at.size(); ++i) {
      const double stop = request_.stop_at[i];
      require(stop >= low && stop <= high, "stop_at[" + std::to_string(i) + "]", stop,
              "must lie between " + text(low) + " and " + text(high));
    }
    require(request_.branches >= 0 && request_.branches <= max_path_branches, "branches", request_.branches,
            "must be 0 to " + std::to_string(max_path_branches));
    if (request_.largest_step) {
      const double step = *request_.largest_step, least = (high - low) / max_path_steps;
      require(std::isfinite(step) && step > least, "largest_step", step, "must be > " + text(least));
    }
  }

 private:
  void require(bool rule_holds, const std::string& key, double value, const std::string& rule) const {
    if (!rule_holds) throw SceneError(source_ + ": path." + key + " = " + text(value) + ": " + rule);
  }
  void finite(const std::string& key, double value) const {
    require(std::isfinite(value), key, value, "must be finite");
  }
  void is_load(const std::string& key, std::size_t load) const {
    require(load < request_.scene.loads.size(), key, static_cast<double>(load),
            "the scene has " + std::to_string(request_.scene.loads.size()) + " loads, counted from 0");
  }

  void check_parameter() const {
    const std::vector<std::size_t>& loads = request_.loads;
    switch (request_.parameter) {
      case PathParameter::load_factor:
        for (std::size_t i = 0; i < loads.size(); ++i) {
          is_load("loads[" + std::to_string(i) + "]", loads[i]);
          require(std::count(loads.begin(), loads.begin() + static_cast<std::ptrdiff_t>(i), loads[i]) == 0,
                  "loads[" + std::to_string(i) + "]", static_cast<double>(loads[i]), "the load is named twice");
        }
        break;
      case PathParameter::turn_rad:
        require(std::abs(request_.axis_B.norm() - 1) < 1e-9, "axis", request_.axis_B.norm(), "must have a direction");
        break;
      case PathParameter::rest_curvature_factor: break;
      case PathParameter::value: {
        require(loads.size() == 1, "load", static_cast<double>(loads.size()), "must be one load");
        is_load("load", loads.front());
        Load load = request_.scene.loads[loads.front()];
        require(request_.component >= 0 && request_.component < static_cast<int>(numbers_of(load).size()), "component",
                request_.component, std::string("a ") + kind_name(load) + " has no such component");
        break;
      }
    }
  }

  bool pulls_tendons() const {
    const auto pulls = [this](std::size_t load) { return tendon_of(request_.scene.loads[load]) != nullptr; };
    if (request_.parameter == PathParameter::value) return pulls(request_.loads.front());
    if (request_.parameter != PathParameter::load_factor) return false;
    if (!request_.loads.empty()) return std::any_of(request_.loads.begin(), request_.loads.end(), pulls);
    return std::any_of(request_.scene.loads.begin(), request_.scene.loads.end(),
                       [](const Load& load) { return tendon_of(load) != nullptr; });
  }

  const PathRequest& request_;
  const std::string& source_;
};

}  // namespace

void validate(const PathRequest& request, const std::string& source) {
  PathChecker(request, source).check();
}

}  // namespace scene
