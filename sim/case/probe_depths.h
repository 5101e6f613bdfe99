// Which depths of a target suit a probe of ultrasound, by the probe's name.
#pragma once

#include <optional>
#include <string_view>

namespace seldinger::cases {

// Of a target's middle below the probe's face, mm.
struct DepthRange {
  double from_mm = 0.0, to_mm = 0.0;
};

// A linear probe is taken down to about 5 cm (teaching texts of regional anaesthesia); nearer than 25 mm a curved
// one has neither width nor a thin slice (our judgement).
inline constexpr DepthRange kLinearSuits{0.0, 50.0}, kCurvedSuits{25.0, 300.0};

// Nothing: there is no probe of that name.
constexpr std::optional<DepthRange> depths_that_suit(std::string_view probe) noexcept {
  if (probe == "L11-5v" || probe == "thesis-linear") return kLinearSuits;
  if (probe == "C5-2v" || probe == "thesis-curved") return kCurvedSuits;
  return std::nullopt;
}

}  // namespace seldinger::cases
