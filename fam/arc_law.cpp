#include "fam/arc_law.h"

#include <array>

namespace fam {
namespace {

template <class... Laws>
constexpr std::array<LawFacts, sizeof...(Laws)> facts_of_all(LawList<Laws...>) {
  return {Laws::facts...};
}
template <class... Laws>
constexpr std::array<Law, sizeof...(Laws)> laws_of_all(LawList<Laws...>) {
  return {Laws::facts.law...};
}

constexpr auto all_facts = facts_of_all(AllLaws{});
constexpr auto every_law = laws_of_all(AllLaws{});
constexpr const char* automatic_name = "auto";

}  // namespace

std::span<const Law> all_laws() {
  return every_law;
}

const LawFacts& facts_of(Law law) {
  for (const LawFacts& facts : all_facts) {
    if (facts.law == law) return facts;
  }
  return AutomaticLaw::facts;
}

Law chosen(Law law) {
  return facts_of(law).law;
}

const char* name(Law law) {
  return law == Law::automatic ? automatic_name : facts_of(law).name;
}

std::optional<Law> law_named(std::string_view name) {
  if (name == automatic_name) return Law::automatic;
  for (const LawFacts& facts : all_facts) {
    if (facts.name == name) return facts.law;
  }
  return std::nullopt;
}

}  // namespace fam
