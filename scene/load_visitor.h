// What is done with loads of any kind: a handler for each. A kind that is added to Load and forgotten somewhere does
// not compile there (tests/load_kind).
#pragma once

#include "scene/load.h"

#include <optional>
#include <span>
#include <type_traits>
#include <utility>

namespace scene {

template <class... Handlers>
struct Overloaded : Handlers... {
  using Handlers::operator()...;
};
template <class... Handlers>
Overloaded(Handlers...) -> Overloaded<Handlers...>;

// Calls the handler for the load's kind; of the handlers, each takes one kind, and none is a fallback.
template <class AnyLoad, class... Handlers>
decltype(auto) visit_load(AnyLoad&& load, Handlers&&... handlers) {
  static_assert(sizeof...(Handlers) == std::variant_size_v<std::remove_cvref_t<AnyLoad>>,
                "a handler for each kind of load");
  return std::visit(Overloaded{std::forward<Handlers>(handlers)...}, std::forward<AnyLoad>(load));
}

// As the scene format spells it.
const char* kind_name(const Load& load);

// In which its components are constant; empty: of a tendon, which pulls along the rod.
std::optional<Frame> frame_of(const Load& load);

bool is_zero(const Load& load);

// The load times a factor.
Load scaled(const Load& load, double factor);

// It has an energy: a fixed force, gravity, a tendon, or zero.
bool is_conservative(const Load& load);

// The numbers of its value; of a tendon, its tension.
std::span<double> numbers_of(Load& load);

// Null: another kind.
const Tendon* tendon_of(const Load& load);

}  // namespace scene
