// The automatic choice on a random scene, beside what would have done.
#pragma once

#include "studies/report/progress.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace studies {

// One scene solved for a tolerance; lengths over L.
struct RandomChoice {
  std::uint64_t seed = 0;
  double tolerance = 0;
  std::string status;                                // of fam::solve
  std::string judge;                                 // "fam", "exact", or "none" where neither answered
  bool gives_way = false;                            // some section shears or stretches
  bool space = false, shear = false, march = false;  // chosen
  int arcs = 0;                                      // chosen
  double error = 0;
  double exact_error = -1;            // on the sample: by the exact reference; below 0: not asked, or no answer
  double off_plane = 0;               // how far the shape leaves the plane that suits it best
  bool shear_needed = false;          // of those chosen with shear: without is no answer within the tolerance
  bool arcs_looked_for = false;       // and another law
  int fewest_arcs = 0;                // fewest that do, else as chosen; 0: none found
  bool fewer_by_another_law = false;  // of order four or two, with fewer arcs than these

  bool judged() const { return status == "converged" && judge != "none"; }
  bool insufficient() const { return !(error <= tolerance); }
  // Of those chosen in space: a plane holds no shape within the tolerance of the true one.
  bool space_needed() const { return off_plane > tolerance; }
  double arcs_ratio() const { return static_cast<double>(arcs) / fewest_arcs; }
};

struct ToAsk {
  bool exact, fewest_arcs;
};
RandomChoice random_choice(std::uint64_t seed, ToAsk asked);

// Scenes 0..count-1 of the mix; every 25th is judged by the exact reference as well, and
// on a quarter, all kinds and tolerances, the fewest arcs are looked for: that takes most of the time. By two threads.
constexpr std::uint64_t exact_every = 25;
std::vector<RandomChoice> random_choices(std::uint64_t count, Progress::Style style);

// The file of them, and those of its rows that follow the ones at hand.
inline const std::string random_file = "accuracy_random.csv";
std::string random_csv(const std::vector<RandomChoice>& choices);
void add_random_choices(const std::filesystem::path& file, std::vector<RandomChoice>& choices);

struct RandomCounts {
  int scenes = 0, unsolved = 0, unjudged = 0;
  int judged = 0;  // solved and judged: the denominator of what follows
  int insufficient = 0;
  int by_exact = 0;  // judged by the exact reference since FAM's finer answer was none
  int space = 0, space_needed = 0;
  int gives_way = 0;  // sections that shear or stretch
  int shear = 0, shear_needed = 0;
  int looked_for = 0;          // of the judged, the fewest arcs: the denominator of what follows
  int other_law = 0;           // another law would do with fewer arcs
  std::vector<double> ratios;  // arcs chosen over fewest
  int within_1 = 0, within_2 = 0, within_4 = 0;
  int smallest = 0;  // in dimension, shear and law, with at most twice the fewest arcs
  int sampled = 0, sampled_insufficient = 0, disagreed = 0;  // by the exact reference: more than a tenth off the judge
};
RandomCounts count_choices(const std::vector<RandomChoice>& choices, const std::string& kind);  // "": all

}  // namespace studies
