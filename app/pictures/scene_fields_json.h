// Reading the objects of a scene file: fields with their ranges; every fault is noted, none throws.
#pragma once

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "app/cli/words.h"
#include "app/pictures/scene.h"
#include "sim/base/result.h"

namespace seldinger::app {

using Json = nlohmann::json;

constexpr double kFar = 1e5;      // mm: no scanner is 100 m long
constexpr int kMaxPixels = 8192;  // per side

// Reads fields of one object and remembers what is wrong and what nobody asked for.
class SceneReader {
 public:
  SceneReader(const Json& json, std::string where, base::Error& error)
      : json_(json), where_(std::move(where)), error_(error) {
    if (!json_.is_object()) bad("", "is not an object");
  }

  void bad(const std::string& field, const std::string& what) {
    const std::string name = field.empty() ? where_ : where_ + "." + field;
    error_.findings.push_back({"bad_scene", name + " " + what});
  }

  bool has(const char* field) {
    asked_.insert(field);
    return json_.is_object() && json_.contains(field);
  }

  const Json& operator[](const char* field) { return json_.at(field); }

  double number(const char* field, double min, double max, std::optional<double> fallback = {}) {
    if (!has(field)) {
      if (!fallback) bad(field, "is missing");
      return fallback.value_or(min);
    }
    const Json& value = json_.at(field);
    if (!value.is_number() || !(value.get<double>() >= min && value.get<double>() <= max)) {
      bad(field, "is not a number in its range");
      return fallback.value_or(min);
    }
    return value.get<double>();
  }

  int whole(const char* field, int min, int max, int fallback) {
    const double value = number(field, min, max, fallback);
    if (value != static_cast<int>(value)) bad(field, "is not a whole number");
    return static_cast<int>(value);
  }

  bool flag(const char* field, bool fallback = false) {
    if (!has(field)) return fallback;
    const Json& value = json_.at(field);
    if (!value.is_boolean()) bad(field, "is neither true nor false");
    return value.is_boolean() ? value.get<bool>() : fallback;
  }

  glm::dvec3 point(const char* field, double min = -kFar, double max = kFar) {
    glm::dvec3 p(0.0);
    if (!has(field)) {
      bad(field, "is missing");
      return p;
    }
    const Json& value = json_.at(field);
    bool good = value.is_array() && value.size() == 3;
    for (int axis = 0; good && axis < 3; ++axis) {
      const Json& component = value.at(static_cast<std::size_t>(axis));
      good = component.is_number() && component.get<double>() >= min && component.get<double>() <= max;
      if (good) p[axis] = component.get<double>();
    }
    if (!good) bad(field, "is not three numbers in their range");
    return p;
  }

  glm::dvec3 unit(const char* field) {
    const glm::dvec3 v = point(field, -1.001, 1.001);
    const double length = glm::length(v);
    if (std::abs(length - 1.0) <= 1e-3) return v / length;
    if (has(field)) bad(field, "is not of unit length");
    return {1.0, 0.0, 0.0};
  }

  // A unit vector across `u`: axes written with a few decimals are meant to be perpendicular.
  glm::dvec3 unit_across(const char* field, const glm::dvec3& u) {
    const glm::dvec3 v = unit(field);
    if (std::abs(glm::dot(u, v)) <= 1e-3) return glm::normalize(v - u * glm::dot(u, v));
    if (has(field)) bad(field, "is not perpendicular to the other axis");
    return v;
  }

  std::string choice(const char* field, const std::vector<std::string>& choices, const char* fallback) {
    if (!has(field)) {
      if (fallback == nullptr) bad(field, "is missing");
      return fallback == nullptr ? choices.front() : fallback;
    }
    const Json& value = json_.at(field);
    if (value.is_string())
      for (const std::string& one : choices)
        if (value.get<std::string>() == one) return one;
    bad(field, "is none of the known words");
    return choices.front();
  }

  std::string text(const char* field) {
    if (!has(field)) return {};
    const Json& value = json_.at(field);
    if (!value.is_string()) bad(field, "is not a text");
    return value.is_string() ? value.get<std::string>() : std::string();
  }

  template <int N>
  std::array<int, N> wholes(const char* field, int max) {
    std::array<int, N> numbers;
    numbers.fill(1);
    if (!has(field)) {
      bad(field, "is missing");
      return numbers;
    }
    const Json& value = json_.at(field);
    bool good = value.is_array() && value.size() == N;
    for (std::size_t i = 0; good && i < N; ++i) {
      good = value.at(i).is_number_integer() && value.at(i).get<long long>() >= 1 &&
             value.at(i).get<long long>() <= max;
      if (good) numbers[i] = value.at(i).get<int>();
    }
    if (!good) bad(field, "is not whole numbers in their range");
    return numbers;
  }

  // "needel" of scene: what is there and nobody asked for, a slip of the pen perhaps.
  void unused(std::vector<std::string>& names) const {
    if (!json_.is_object()) return;
    for (const auto& [key, value] : json_.items())
      if (!asked_.contains(key)) names.push_back(shown(key) + " of " + where_);
  }

 private:
  const Json& json_;
  std::string where_;
  base::Error& error_;
  std::set<std::string> asked_;
};

RoomSceneView read_room(const Json& json, base::Error& error, std::vector<std::string>& unused);
UltrasoundSceneView read_ultrasound(const Json& json, bool echogenic_needle, base::Error& error,
                                    std::vector<std::string>& unused);

}  // namespace seldinger::app
