#include "studies/report/provenance.h"

#include "studies/report/output_file.h"

#include "build_info.h"
#include "commit.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <fstream>

namespace studies {
namespace {

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(": ") + 2);
  }
  return "unknown";
}

std::string checksum(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : text) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return fmt::format("{:016x}", hash);
}

}  // namespace

std::string commit() {
  return build_info::commit;
}

std::string machine_line() {
  return fmt::format("{}; {} {}; one thread", processor(), build_info::compiler, build_info::flags);
}

void write_results(const std::filesystem::path& folder, const std::string& command,
                   const std::map<std::string, std::string>& files) {
  nlohmann::ordered_json json{{"command", command},
                              {"commit", build_info::commit},
                              {"compiler", build_info::compiler},
                              {"flags", build_info::flags},
                              {"processor", processor()}};
  for (const auto& [library, version] : build_info::libraries) json["libraries"][library] = version;
  for (const auto& [name, text] : files) {
    write_file(folder / name, text);
    json["fnv1a_64"][name] = checksum(text);
  }
  write_file(folder / "provenance.json", json.dump(2) + "\n");
}

}  // namespace studies
