// Needle gauges 16 to 25: nominal outer and inner diameters of regular-wall tubing (Birmingham wire gauge, as
// makers' charts list it; within the limits of ISO 9626:2016).
#pragma once

#include <array>
#include <optional>

namespace seldinger::cases {

struct Gauge {
  int number;
  double outer_mm, inner_mm;  // diameters
};

inline constexpr std::array<Gauge, 10> kGauges = {{{16, 1.651, 1.194},
                                                   {17, 1.473, 1.067},
                                                   {18, 1.270, 0.838},
                                                   {19, 1.067, 0.686},
                                                   {20, 0.908, 0.603},
                                                   {21, 0.819, 0.514},
                                                   {22, 0.718, 0.413},
                                                   {23, 0.642, 0.337},
                                                   {24, 0.566, 0.311},
                                                   {25, 0.515, 0.260}}};

// Of a coaxial set's introducer about a needle: one wall of its tube. About 18 gauge it is 17 gauge outside.
inline constexpr double kIntroducerWallMm = 0.1;

// Nothing for a number that is not in the table.
constexpr std::optional<Gauge> gauge(int number) noexcept {
  for (const Gauge& one : kGauges)
    if (one.number == number) return one;
  return std::nullopt;
}

}  // namespace seldinger::cases
