// The names of the arc laws, and what tells them apart; the laws themselves: fam/arc_law.h.
#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace fam {

enum class Law { automatic, published, midpoint, fourth_order, sixth_order };

struct LawFacts {
  Law law;
  const char* name;
  int order;       // of the error in h; in space, where it is less than in the plane
  bool coupled;    // bending, torsion, shear and stretch are one screw: the law takes every scene, in plane and space
  bool by_series;  // has no answer where the series of an arc does not reach its end
};

// All but automatic.
std::span<const Law> all_laws();
// Automatic: of the law that it stands for.
const LawFacts& facts_of(Law law);
// The one that automatic stands for, or the law itself.
Law chosen(Law law);

const char* name(Law law);  // automatic: "auto"
std::optional<Law> law_named(std::string_view name);

}  // namespace fam
