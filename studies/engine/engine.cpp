#include "studies/engine/engine.h"

#include "scene/scene.h"
#include "studies/report/output_file.h"
#include "studies/report/provenance.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iterator>

namespace studies {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr std::uint64_t items_a_folder = 1'000'000;

std::uint64_t end_of(const CampaignPlan& plan, std::uint64_t from) {
  return std::min(from + plan.chunk, plan.items);
}

fs::path path_of(const CampaignPlan& plan, std::uint64_t from) {
  return plan.folder / "chunks" / fmt::format("{:06}", from / items_a_folder) /
         fmt::format("{:012}-{:012}.csv", from, end_of(plan, from) - 1);
}

// The last line of a chunk's file, by which it is known as whole.
std::string end_line(const CampaignPlan& plan, std::uint64_t from) {
  return fmt::format("end,{},{},{},{}\n", plan.kind, plan.identity, from, end_of(plan, from) - 1);
}

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(file), {});
  if (!file) throw OutputError(path.string() + ": cannot be read");
  return text;
}

// Parts of files, and the shorter last chunk of what was a smaller campaign.
void remove_leftovers(const CampaignPlan& plan) {
  if (!fs::is_directory(plan.folder / "chunks")) return;
  std::vector<fs::path> leftovers;
  for (const auto& entry : fs::recursive_directory_iterator(plan.folder / "chunks")) {
    const std::uint64_t from = std::strtoull(entry.path().filename().c_str(), nullptr, 10);
    const bool of_plan = from < plan.items && entry.path() != path_of(plan, from);
    if (entry.is_regular_file() && (entry.path().extension() != ".csv" || of_plan)) leftovers.push_back(entry.path());
  }
  for (const fs::path& path : leftovers) fs::remove(path);
}

std::vector<std::uint64_t> missing_chunks(const CampaignPlan& plan) {
  remove_leftovers(plan);
  std::vector<std::uint64_t> missing;
  for (std::uint64_t from = 0; from < plan.items; from += plan.chunk) {
    const fs::path path = path_of(plan, from);
    if (!fs::exists(path) || !ends_with(text_of(path), end_line(plan, from))) missing.push_back(from);
  }
  return missing;
}

// Refuses the folder of another campaign; adds this build to the manifest's.
void write_manifest(const CampaignPlan& plan) {
  const fs::path path = plan.folder / "manifest.json";
  Json manifest{{"kind", plan.kind}, {"asked", plan.identity}, {"chunk", plan.chunk}, {"commits", Json::array()}};
  std::error_code none;
  if (!fs::exists(path) && fs::directory_iterator(plan.folder / "chunks", none) != fs::directory_iterator())
    throw scene::SceneError(path.string() + ": (missing): says whose the chunks in this folder are; a campaign that " +
                            "begins needs a folder of its own");
  if (fs::exists(path)) {
    const Json found = Json::parse(text_of(path), nullptr, false);
    for (const char* key : {"kind", "asked", "chunk"}) {
      if (!found.is_object() || !found.contains(key) || found[key] != manifest[key]) {
        const std::string value = found.is_object() && found.contains(key) ? found[key].dump() : "(missing)";
        throw scene::SceneError(path.string() + ": " + key + ": " + value + ": this run has " + manifest[key].dump() +
                                "; it needs a folder of its own");
      }
    }
    if (found.contains("commits") && found["commits"].is_array()) manifest["commits"] = found["commits"];
  }
  Json& commits = manifest["commits"];
  if (std::find(commits.begin(), commits.end(), commit()) == commits.end()) commits.push_back(commit());
  manifest["items"] = plan.items;
  write_file(path, manifest.dump(2) + "\n");
}

void add_timing(const CampaignPlan& plan, const Crew& crew, std::uint64_t done, double seconds) {
  const fs::path path = plan.folder / "timing.csv";
  std::string text = fs::exists(path) ? text_of(path) : "ranks,scenes,seconds,scenes_per_second\n";
  text += fmt::format("{},{},{:.3f},{:.1f}\n", crew.size(), done, seconds, static_cast<double>(done) / seconds);
  write_file(path, text);
}

// A failure of one process is everybody's: it throws there, the others return false, and all have gone through.
bool together(Crew& crew, const std::function<void()>& work) {
  std::exception_ptr failure;
  try {
    work();
  } catch (const std::exception&) {
    failure = std::current_exception();
  }
  const bool failed = crew.any(failure != nullptr);
  if (failure) std::rethrow_exception(failure);
  return !failed;
}

class Clock {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// All chunks that the counter gives to this process.
void work_off(Crew& crew, const CampaignPlan& plan, const std::vector<std::uint64_t>& missing, const ChunkWork& work,
              Progress& progress) {
  constexpr double report_every_s = 1;
  const Clock clock;
  double next_report_s = 0;
  for (std::uint64_t k; (k = crew.next()) < missing.size();) {
    if (clock.seconds() >= next_report_s) {
      const double rate = static_cast<double>(k * plan.chunk) / std::max(clock.seconds(), 1e-9);
      progress.at(k, k == 0 ? "begins" : fmt::format("{:.0f} a second", rate));
      next_report_s = clock.seconds() + report_every_s;
    }
    try {
      const std::uint64_t from = missing[k];
      write_file(path_of(plan, from), work(from, end_of(plan, from), [&] { crew.help(); }) + end_line(plan, from));
    } catch (...) {
      crew.skip_to(missing.size());
      throw;
    }
  }
}

}  // namespace

bool run_chunks(Crew& crew, const CampaignPlan& plan, const ChunkWork& work, Progress::Style style) {
  std::vector<std::uint64_t> missing;
  const bool ready = together(crew, [&] {
    if (!crew.leads()) return;
    write_manifest(plan);
    missing = missing_chunks(plan);
  });
  if (!ready) return false;
  missing = crew.from_leader(std::move(missing));
  const Clock clock;
  {
    Progress progress("campaign " + plan.kind, missing.size(), crew.leads() ? style : Progress::Style::quiet);
    if (!together(crew, [&] { work_off(crew, plan, missing, work, progress); })) return false;
  }
  const std::uint64_t done = std::min<std::uint64_t>(missing.size() * plan.chunk, plan.items);
  return together(crew, [&] {
    if (crew.leads() && done > 0) add_timing(plan, crew, done, clock.seconds());
  });
}

void read_chunks(const CampaignPlan& plan, const std::function<void(const std::string& text)>& take) {
  for (std::uint64_t from = 0; from < plan.items; from += plan.chunk) {
    const fs::path path = path_of(plan, from);
    const std::string text = text_of(path), end = end_line(plan, from);
    if (!ends_with(text, end)) throw OutputError(path.string() + ": is not whole; the next run does it again");
    take(text.substr(0, text.size() - end.size()));
  }
}

}  // namespace studies
