// A JSON value with its path, read key by key: what is missing, unknown or of another kind is refused.
#pragma once

#include "scene/json_file.h"
#include "scene/scene.h"

#include <initializer_list>
#include <vector>

namespace scene {

class JsonNode {
 public:
  JsonNode(const Json& json, std::string path, const std::string& source)
      : json_(json), path_(std::move(path)), source_(source) {}

  [[noreturn]] void refuse(const std::string& rule) const { scene::refuse(source_, path_, dump(json_), rule); }

  void require_object() const {
    if (!json_.is_object()) refuse("must be an object");
  }

  // Refuses anything but an object with these keys.
  void allow_keys(std::initializer_list<const char*> keys) const {
    require_object();
    for (const auto& [key, value] : json_.items()) {
      bool known = false;
      std::string all;
      for (const char* allowed : keys) {
        known |= key == allowed;
        all += (all.empty() ? "" : ", ") + std::string(allowed);
      }
      if (!known) scene::refuse(source_, join(path_, key), dump(value), "unknown key; known here: " + all);
    }
  }

  bool has(const char* key) const { return json_.contains(key); }

  JsonNode at(const char* key) const {
    if (!has(key)) scene::refuse(source_, join(path_, key), "(missing)", "the key is required");
    return {json_.at(key), join(path_, key), source_};
  }

  std::vector<JsonNode> items() const {
    if (!json_.is_array()) refuse("must be an array");
    std::vector<JsonNode> nodes;
    for (std::size_t i = 0; i < json_.size(); ++i) {
      nodes.emplace_back(json_[i], path_ + "[" + std::to_string(i) + "]", source_);
    }
    return nodes;
  }

  double number(const std::string& rule = "must be a number") const {
    if (!json_.is_number()) refuse(rule);
    return json_.get<double>();
  }

  // A count, or a place in a list.
  int whole_number() const {
    if (!json_.is_number_integer() || json_.get<double>() < 0 || json_.get<double>() > 1e9)
      refuse("must be a whole number >= 0");
    return json_.get<int>();
  }

  double number_or(const char* key, double otherwise) const { return has(key) ? at(key).number() : otherwise; }

  std::string string() const {
    if (!json_.is_string()) refuse("must be a string");
    return json_.get<std::string>();
  }

  template <int Size>
  Eigen::Matrix<double, Size, 1> vector() const {
    if (!json_.is_array() || json_.size() != Size) refuse("must be an array of " + std::to_string(Size) + " numbers");
    Eigen::Matrix<double, Size, 1> values;
    for (int i = 0; i < Size; ++i) values[i] = items()[static_cast<std::size_t>(i)].number();
    return values;
  }

  // A number for both axes, or [y, z].
  Eigen::Vector2d number_or_pair() const {
    if (json_.is_number()) return Eigen::Vector2d::Constant(number());
    if (!json_.is_array()) refuse("must be a number or an array of 2 numbers");
    return vector<2>();
  }

  bool is_number() const { return json_.is_number(); }
  bool is_true() const { return json_ == true; }
  bool is_tip() const { return json_ == "tip"; }

  Frame frame() const {
    if (json_ == "follower") return Frame::follower;
    if (json_ == "fixed") return Frame::fixed;
    refuse("must be \"follower\" or \"fixed\"");
  }

 private:
  const Json& json_;
  std::string path_;
  const std::string& source_;
};

// The scene that stands there, not yet validated.
Scene scene_of(const JsonNode& node);

}  // namespace scene
