// What a campaign keeps of its scenes: counts, histograms, the worst by each measure where it is finite, every failure.
// Tallies of parts add up to that of the whole, whatever the parts and their order, to the byte.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace studies {

struct Measure {
  std::string name;
  double value = 0;
};

// What came of one scene.
struct SceneOutcome {
  std::uint64_t index = 0;
  std::string kind;      // of scene
  std::string outcome;   // words, no comma
  bool failure = false;  // kept with its index
  std::vector<Measure> measures;
};

class Tally {
 public:
  static constexpr std::size_t worst_kept = 10;  // of each measure

  void add(const SceneOutcome& scene);
  void add(const Tally& part);

  // Lines of cells with commas; read back to the same. Throws std::runtime_error on text that is none.
  std::string text() const;
  static Tally from_text(const std::string& text);

  struct Worst {
    double value;
    std::uint64_t index;
    std::string kind;
    bool operator<(const Worst& other) const {
      return value != other.value ? value > other.value : index < other.index;
    }
  };
  struct Failure {
    std::uint64_t index;
    std::string kind, outcome, numbers;  // numbers: "position=1.2e-03 ..."
    bool operator<(const Failure& other) const { return index < other.index; }
  };

  using CountKey = std::pair<std::string, std::string>;  // kind, outcome
  const std::map<CountKey, std::uint64_t>& counts() const { return counts_; }
  const std::map<std::string, std::map<int, std::uint64_t>>& histograms() const { return histograms_; }
  const std::map<std::string, std::set<Worst>>& worst() const { return worst_; }
  const std::set<Failure>& failures() const { return failures_; }

  std::uint64_t scenes() const;  // of all kinds

 private:
  void keep(const std::string& measure, const Worst& worst);

  std::map<CountKey, std::uint64_t> counts_;
  std::map<std::string, std::map<int, std::uint64_t>> histograms_;  // by measure and bin
  std::map<std::string, std::set<Worst>> worst_;
  std::set<Failure> failures_;
};

// Bins of half decades: 10^(bin/2) up to 10^((bin+1)/2); zero and what is below 1e-16 in the first, infinity in the
// last.
int bin_of(double value);

}  // namespace studies
