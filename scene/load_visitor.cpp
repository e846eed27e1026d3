#include "scene/load_visitor.h"

namespace scene {

const char* kind_name(const Load& load) {
  return visit_load(
      load, [](const Force&) { return "force"; },                                                             //
      [](const Moment&) { return "moment"; },                                                                 //
      [](const DistributedForce&) { return "distributed_force"; }, [](const Gravity&) { return "gravity"; },  //
      [](const Tendon&) { return "tendon"; });
}

std::optional<Frame> frame_of(const Load& load) {
  using Result = std::optional<Frame>;
  return visit_load(
      load, [](const Force& force) -> Result { return force.frame; },
      [](const Moment& moment) -> Result { return moment.frame; },
      [](const DistributedForce& force) -> Result { return force.frame; },
      [](const Gravity&) -> Result { return Frame::fixed; },  //
      [](const Tendon&) -> Result { return std::nullopt; });
}

bool is_zero(const Load& load) {
  return visit_load(
      load, [](const Force& force) { return force.value_N.isZero(0); },
      [](const Moment& moment) { return moment.value_Nmm.isZero(0); },
      [](const DistributedForce& force) { return force.value_N_per_mm.isZero(0); },
      [](const Gravity& gravity) { return gravity.acceleration_m_per_s2.isZero(0); },
      [](const Tendon& tendon) { return tendon.tension_N == 0; });
}

std::span<double> numbers_of(Load& load) {
  using Numbers = std::span<double>;
  return visit_load(
      load,
      [](Force& force) -> Numbers {
        return {force.value_N.data(), 3};
      },
      [](Moment& moment) -> Numbers {
        return {moment.value_Nmm.data(), 3};
      },
      [](DistributedForce& force) -> Numbers {
        return {force.value_N_per_mm.data(), 3};
      },
      [](Gravity& gravity) -> Numbers {
        return {gravity.acceleration_m_per_s2.data(), 3};
      },
      [](Tendon& tendon) -> Numbers {
        return {&tendon.tension_N, 1};
      });
}

Load scaled(const Load& load, double factor) {
  Load result = load;
  for (double& number : numbers_of(result)) number *= factor;
  return result;
}

bool is_conservative(const Load& load) {
  if (is_zero(load)) return true;
  return visit_load(
      load, [](const Force& force) { return force.frame == Frame::fixed; },  //
      [](const Moment&) { return false; }, [](const DistributedForce& force) { return force.frame == Frame::fixed; },
      [](const Gravity&) { return true; },  //
      [](const Tendon&) { return true; });
}

const Tendon* tendon_of(const Load& load) {
  using Result = const Tendon*;
  return visit_load(
      load, [](const Force&) -> Result { return nullptr; },  //
      [](const Moment&) -> Result { return nullptr; }, [](const DistributedForce&) -> Result { return nullptr; },
      [](const Gravity&) -> Result { return nullptr; },  //
      [](const Tendon& tendon) -> Result { return &tendon; });
}

}  // namespace scene
