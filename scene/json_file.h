// The text of a scene file as JSON, and errors that name a value by its JSON path.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <istream>
#include <string>

namespace scene {

using Json = nlohmann::ordered_json;

// Throws SceneError if the text is not JSON, gives a key twice or holds what no scene needs.
Json parse(const std::string& text, const std::string& source);
// The same of a stream, of at most max_scene_file_bytes.
Json read_json(std::istream& input, const std::string& source);

// Opens a file, or standard input where path is "-"; `what` it should be, for the refusal of one that cannot be read.
void with_file(const std::string& path, const std::string& what,
               const std::function<void(std::istream&, const std::string&)>& read);

[[noreturn]] void refuse(const std::string& source, const std::string& path, const std::string& value,
                         const std::string& rule);

// Of any value; of a key below a path.
std::string dump(const Json& value);
std::string join(const std::string& path, const std::string& key);

}  // namespace scene
