// Two calipers on a picture, in millimetres of it (picture_mm): they stay where they were set whatever depth, size
// or side the picture is shown at.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace seldinger::app {

class Calipers {
 public:
  static constexpr std::size_t kMost = 2;
  static constexpr double kAtFaceMm = 8.0;  // a curved face is lower in its middle than at its sides (design)

  // A press at a point: takes the nearest end within `reach_mm`, else sets a new one; what is too much begins anew.
  void press(const glm::dvec2& at_mm, double reach_mm);
  // What was taken or set goes along until it is released.
  void drag(const glm::dvec2& at_mm) noexcept;
  void release() noexcept { held_.reset(); }
  void clear() noexcept;

  const std::vector<glm::dvec2>& ends_mm() const noexcept { return ends_mm_; }  // pairs; the last may be alone
  // Of a whole pair; nothing where there is none.
  std::optional<double> length_mm(std::size_t caliper) const noexcept;
  // How deep a caliper that begins at the face, at most kAtFaceMm below it, ends; nothing where it does not, or is
  // no pair.
  std::optional<double> depth_mm(std::size_t caliper) const noexcept;
  std::optional<std::size_t> held() const noexcept {  // which caliper
    return held_ ? std::optional(*held_ / 2) : std::nullopt;
  }
  // "A 12.3 mm", "B 8.1 mm", and of both the ellipse that has them as axes; no line for what is not there.
  std::vector<std::string> words() const;

 private:
  std::vector<glm::dvec2> ends_mm_;
  std::optional<std::size_t> held_;
};

}  // namespace seldinger::app
