#include "studies/benchmark_page.h"

namespace studies {

std::string benchmark_text(const std::string& key) {
  static const std::map<std::string, std::string> texts = {
      {"page", "# Benchmarks\n"}, {"files", ""}, {"headline", "## [Benchmarks](benchmarks/README.md)\n"}};
  const auto found = texts.find(key);
  return found == texts.end() ? "" : found->second;
}

}  // namespace studies
