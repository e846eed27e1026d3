#include "studies/campaign/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <stdexcept>

namespace studies {
namespace {

constexpr int first_bin = -32, last_bin = 32;

// Seventeen digits: read back to the same value.
std::string exactly(double value) {
  return fmt::format("{:.16e}", value);
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  return cells;
}

}  // namespace

int bin_of(double value) {
  if (!(value > 1e-16)) return first_bin;
  if (!(value < 1e16)) return last_bin;
  return static_cast<int>(std::floor(2 * std::log10(value)));
}

void Tally::keep(const std::string& measure, const Worst& worst) {
  if (!std::isfinite(worst.value)) return;
  std::set<Worst>& list = worst_[measure];
  list.insert(worst);
  if (list.size() > worst_kept) list.erase(std::prev(list.end()));
}

void Tally::add(const SceneOutcome& scene) {
  ++counts_[{scene.kind, scene.outcome}];
  std::string numbers;
  for (const auto& [name, value] : scene.measures) {
    ++histograms_[name][bin_of(value)];
    keep(name, {value, scene.index, scene.kind});
    numbers += fmt::format("{}{}={:.3e}", numbers.empty() ? "" : " ", name, value);
  }
  if (scene.failure) failures_.insert({scene.index, scene.kind, scene.outcome, numbers});
}

void Tally::add(const Tally& part) {
  for (const auto& [key, n] : part.counts_) counts_[key] += n;
  for (const auto& [measure, bins] : part.histograms_) {
    for (const auto& [bin, n] : bins) histograms_[measure][bin] += n;
  }
  for (const auto& [measure, list] : part.worst_) {
    for (const Worst& worst : list) keep(measure, worst);
  }
  failures_.insert(part.failures_.begin(), part.failures_.end());
}

std::string Tally::text() const {
  std::string text;
  for (const auto& [key, n] : counts_) text += fmt::format("count,{},{},{}\n", key.first, key.second, n);
  for (const auto& [measure, bins] : histograms_) {
    for (const auto& [bin, n] : bins) text += fmt::format("bin,{},{},{}\n", measure, bin, n);
  }
  for (const auto& [measure, list] : worst_) {
    for (const Worst& w : list) text += fmt::format("worst,{},{},{},{}\n", measure, exactly(w.value), w.index, w.kind);
  }
  for (const Failure& f : failures_)
    text += fmt::format("failure,{},{},{},{}\n", f.index, f.kind, f.outcome, f.numbers);
  return text;
}

Tally Tally::from_text(const std::string& text) {
  Tally tally;
  std::istringstream stream(text);
  const auto whole = [](const std::string& cell) { return std::stoull(cell); };
  for (std::string line; std::getline(stream, line);) {
    const std::vector<std::string> c = cells_of(line);
    if (c.size() == 4 && c[0] == "count") tally.counts_[{c[1], c[2]}] += whole(c[3]);
    else if (c.size() == 4 && c[0] == "bin") tally.histograms_[c[1]][std::stoi(c[2])] += whole(c[3]);
    else if (c.size() == 5 && c[0] == "worst")
      tally.keep(c[1], {std::strtod(c[2].c_str(), nullptr), whole(c[3]), c[4]});
    else if ((c.size() == 4 || c.size() == 5) && c[0] == "failure")
      tally.failures_.insert({whole(c[1]), c[2], c[3], c.size() == 5 ? c[4] : ""});
    else throw std::runtime_error("no line of a tally: " + line);
  }
  return tally;
}

std::uint64_t Tally::scenes() const {
  std::uint64_t sum = 0;
  for (const auto& [key, n] : counts_) sum += n;
  return sum;
}

}  // namespace studies
