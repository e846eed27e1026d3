#include "scene/json_file.h"

#include "scene/scene_file.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>
#include <vector>

namespace scene {
namespace {

// What no scene needs, refused while the file is read, so that time and memory stay in proportion to its size.
constexpr int max_depth = 16;          // scenes need 6, estimation files 9
constexpr std::size_t max_keys = 32;   // of one object; paths need 8
constexpr int max_values = 4'000'000;  // of the file; 100 000 loads need some 2 million

// Text from the file for an error message: one line of printable ASCII, other bytes as \xHH, cut where it is longer.
std::string printable(const std::string& text, std::size_t longest) {
  constexpr const char* digits = "0123456789abcdef";
  std::string shown;
  for (const char c : text) {
    if (shown.size() >= longest) return shown + "...";
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= ' ' && byte <= '~') shown += c;
    else shown += {'\\', 'x', digits[byte / 16], digits[byte % 16]};
  }
  return shown;
}

}  // namespace

void refuse(const std::string& source, const std::string& path, const std::string& value, const std::string& rule) {
  const std::string where = path.empty() ? "(top level)" : printable(path, 200);
  throw SceneError(source + ": " + where + " = " + printable(value, 80) + ": " + printable(rule, 300));
}

std::string dump(const Json& value) {
  return value.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string join(const std::string& path, const std::string& key) {
  const std::string shown = printable(key, 60);
  return path.empty() ? shown : path + "." + shown;
}

namespace {

// Follows a parser so that an error inside the text can be named by its JSON path; refuses what no scene needs, and a
// key given twice, of which a JSON parser would silently keep the last. A pass of its own: the parser's own callback
// looks at all members of an array after each.
class PathTracker : public nlohmann::json_sax<Json> {
 public:
  explicit PathTracker(const std::string& source) : source_(source) {}

  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_object(std::size_t) override { return start(false); }
  bool end_object() override { return end(); }
  bool start_array(std::size_t) override { return start(true); }
  bool end_array() override { return end(); }

  bool key(string_t& name) override {
    count();
    Level& level = levels_.back();
    level.key = name;
    if (level.keys.size() == max_keys) refuse(source_, path(), dump(name), "more keys than an object here can have");
    if (!level.keys.insert(name).second) refuse(source_, path(), dump(name), "the key is given twice");
    return true;
  }

  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    const std::string what = error.what();
    if (dynamic_cast<const Json::out_of_range*>(&error)) {  // "... number overflow parsing '1e999'"
      const std::size_t quote = what.find('\'');
      const std::string number =
          quote == std::string::npos ? "?" : what.substr(quote + 1, what.rfind('\'') - quote - 1);
      refuse(source_, path(), number, "must be finite: the number does not fit a double");
    }
    // "[json.exception...] parse error at line 1, column 2: ..."
    refuse(source_, path(), "(unreadable)", "not JSON: " + what.substr(what.find("] ") + 2));
  }

 private:
  std::string path() const {
    std::string text;
    for (const Level& level : levels_) {
      if (level.is_array) text += "[" + std::to_string(level.index) + "]";
      else if (!level.key.empty()) text = join(text, level.key);
    }
    return text;
  }
  void count() {
    if (++values_ > max_values) refuse(source_, path(), "(too much)", "more values than a scene can have");
  }
  bool start(bool is_array) {
    count();
    levels_.push_back({is_array, {}, {}, 0});
    if (levels_.size() > max_depth) refuse(source_, path(), "{...", "nested too deeply for a scene");
    return true;
  }
  bool end() {
    levels_.pop_back();
    return value();
  }
  bool value() {
    count();
    if (!levels_.empty() && levels_.back().is_array) ++levels_.back().index;
    return true;
  }

  struct Level {
    bool is_array;
    std::set<std::string> keys;
    std::string key;
    int index;
  };

  const std::string& source_;
  std::vector<Level> levels_;
  int values_ = 0;  // beginnings, ends, keys and values
};

}  // namespace

Json parse(const std::string& text, const std::string& source) {
  if (text.find('\0') != std::string::npos) {  // the parser would stop there and not see the rest
    refuse(source, "", "(unreadable)", "not JSON: byte " + std::to_string(text.find('\0')) + " is zero");
  }
  PathTracker tracker(source);
  Json::sax_parse(text, &tracker);
  return Json::parse(text);
}

Json read_json(std::istream& input, const std::string& source) {
  std::string text;
  char block[1 << 16];
  while (input.read(block, sizeof block), input.gcount() > 0) {
    text.append(block, static_cast<std::size_t>(input.gcount()));
    if (text.size() > max_scene_file_bytes) {
      refuse(source, "", "(too large)", "a scene file has at most " + std::to_string(max_scene_file_bytes) + " bytes");
    }
  }
  return parse(text, source);
}

void with_file(const std::string& path, const std::string& what,
               const std::function<void(std::istream&, const std::string&)>& read) {
  if (path == "-") return read(std::cin, "(standard input)");
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path))
    throw SceneError(path + ": (file) = (unreadable): must be a readable " + what + " file");
  read(file, path);
}

}  // namespace scene
