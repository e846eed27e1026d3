#include "studies/report/file_options.h"

#include <filesystem>

namespace studies {
namespace {

namespace fs = std::filesystem;

// Devices and pipes, such as /dev/null, may be written to twice.
bool is_same_file(const std::string& a, const std::string& b) {
  if (a.empty() || a == "-" || b.empty() || b == "-") return false;
  std::error_code error;
  if (fs::exists(a, error) && !fs::is_regular_file(a, error)) return false;
  const auto canonical = [&](const std::string& path) { return fs::weakly_canonical(fs::absolute(path), error); };
  return fs::equivalent(a, b, error) || canonical(a) == canonical(b);
}

}  // namespace

CLI::Option* add_file_option(CLI::App* command, const std::string& option, std::string& path, const std::string& what) {
  const auto no_name = [](const std::string& text) { return text.empty() ? "must name a file" : ""; };
  return command->add_option(option, path, what)->check(CLI::Validator(no_name, "FILE"));
}

void refuse_overwriting(const NamedFiles& inputs, const NamedFiles& outputs) {
  NamedFiles before = inputs;
  for (const auto& [option, path] : outputs) {
    for (const auto& [name, other] : before) {
      if (is_same_file(path, other)) throw CLI::ValidationError(option, "names the file of " + name);
    }
    before.emplace_back(option, path);
  }
}

}  // namespace studies
