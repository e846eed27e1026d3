#include "studies/report/page.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

namespace studies {
namespace {

// One pass over the words of a page.
class Filler {
 public:
  Filler(const std::string& words, const std::string& source) : words_(words), source_(source) {}

  // Up to the next {{...}}, which `name` takes; false at the end of the words.
  bool next(std::string& plain, std::string& name) {
    const std::size_t open = words_.find("{{", at_);
    plain = words_.substr(at_, open - at_);
    if (open == std::string::npos) return false;
    const std::size_t close = words_.find("}}", open);
    if (close == std::string::npos) fail("{{ without }}");
    name = words_.substr(open + 2, close - open - 2);
    at_ = close + 2;
    return true;
  }

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = std::count(words_.begin(), words_.begin() + static_cast<std::ptrdiff_t>(at_), '\n') + 1;
    throw PageError(fmt::format("{}:{}: {}", source_, line, what));
  }

 private:
  const std::string& words_;
  const std::string& source_;
  std::size_t at_ = 0;
};

std::string contents(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw PageError(path.string() + ": cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::string timed(const std::string& text) {
  const bool block = text.find('\n') != std::string::npos;
  return block ? "<!--t-->\n" + text + (text.back() == '\n' ? "" : "\n") + "<!--/t-->\n"
               : "<!--t-->" + text + "<!--/t-->";
}

void Page::set(const std::string& name, const std::string& text) {
  if (!texts_.emplace(name, text).second) throw PageError("{{" + name + "}} is set twice");
}

void Page::set_time(const std::string& name, const std::string& text) {
  set(name, timed(text));
}

void Page::check(const std::string& name, bool holds) {
  if (!checks_.emplace(name, Check{holds, false}).second) throw PageError("{{?" + name + "}} is set twice");
}

void Page::check_time(const std::string& name, bool holds) {
  check(name, holds);
  checks_.at(name).timed = true;
}

std::string Page::fill(const std::filesystem::path& page_md) const {
  return fill_text(contents(page_md), page_md.string());
}

std::string Page::fill_text(const std::string& words, const std::string& source) const {
  Filler filler(words, source);
  std::set<std::string> used;
  std::string page, plain, name, branch;
  const Check* open = nullptr;  // the check whose words are read
  bool shown = true;
  const auto add = [&](const std::string& text) {
    if (shown) (open != nullptr ? branch : page) += text;
  };
  for (bool more = true; more;) {
    more = filler.next(plain, name);
    add(plain);
    if (!more) break;
    if (name[0] == '?') {
      const auto check = checks_.find(name.substr(1));
      if (open != nullptr) filler.fail("a check within a check: {{" + name + "}}");
      if (check == checks_.end()) filler.fail("nobody set {{" + name + "}}");
      used.insert(name);
      open = &check->second;
      shown = open->holds;
      branch.clear();
    } else if (name == ":") {
      if (open == nullptr) filler.fail("{{:}} outside a check");
      shown = !open->holds;
    } else if (name == "/") {
      if (open == nullptr) filler.fail("{{/}} outside a check");
      page += open->timed ? "<!--t-->" + branch + "<!--/t-->" : branch;  // whatever the branch, one shape
      open = nullptr;
      shown = true;
    } else {
      const auto text = texts_.find(name);
      if (text == texts_.end()) filler.fail("nobody set {{" + name + "}}");
      used.insert(name);
      add(text->second);
    }
  }
  if (open != nullptr) filler.fail("a check without its {{/}}");
  for (const auto& [known, text] : texts_) {
    if (used.count(known) == 0) throw PageError(source + ": {{" + known + "}} is set but not used");
  }
  for (const auto& [known, check] : checks_) {
    if (used.count("?" + known) == 0) throw PageError(source + ": {{?" + known + "}} is set but not used");
  }
  return page;
}

std::string answers_json(const Answers& answers) {
  return nlohmann::ordered_json(answers).dump(2) + "\n";
}

Answers read_answers(const std::filesystem::path& path) {
  std::ifstream file(path);
  return file ? nlohmann::json::parse(file).get<Answers>() : Answers{};
}

}  // namespace studies
