// What flows through an open needle: what comes back out of the lumen that its tip is in, and contrast medium that
// is injected. Written by engine/needle_flow; part of State.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>

namespace seldinger::cases {

// What a lumen holds. Saved: numbers stay as they are.
enum class LumenContent : std::uint8_t {
  none = 0,
  urine = 1,
  bile = 2,
  venous_blood = 3,
  arterial_blood = 4,
  fluid = 5  // of a cyst, an abscess, an effusion, or what nobody named
};

// Contrast medium that lies in a lumen, or as a depot in tissue.
struct ContrastPool {
  std::int32_t lumen = -1;         // of tissue::Lumens; −1: none, in tissue
  glm::dvec3 at_rest_lps_mm{0.0};  // where it came out of the needle first, as the CT has it
  double spread_ml = 0.0;          // of the lumen, from there on, that it has reached
  double contrast_ml = 0.0;        // as it was injected; > 0 where there is any
  bool operator==(const ContrastPool&) const = default;
};
inline constexpr std::size_t kContrastPools = 4;  // at a time

struct NeedleFlow {
  bool in_use = false;  // since a stylet was drawn, or something drawn or injected through a needle in tissue
  bool stylet_out = false;
  LumenContent column = LumenContent::none;     // what runs up the needle,
  double column_ml = 0.0;                       // and how much of it there has been
  LumenContent at_hub = LumenContent::none;     // what came out at the hub last
  LumenContent aspirated = LumenContent::none;  // what the last aspiration brought
  double syringe_ml = 0.0;                      // of contrast, still to be pushed
  double injected_ml = 0.0;      // into the body: what the pools hold and what was carried away, together
  double carried_away_ml = 0.0;  // by what flows in the lumens
  std::array<ContrastPool, kContrastPools> pools{};
};

// Contrast in a pool, as a share of what was injected.
inline double concentration(const ContrastPool& pool) noexcept {
  return pool.spread_ml > 0.0 ? pool.contrast_ml / pool.spread_ml : 0.0;
}

}  // namespace seldinger::cases
