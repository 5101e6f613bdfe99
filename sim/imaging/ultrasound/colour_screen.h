// Colour Doppler on the screen: which colour each pixel has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/imaging/ultrasound/colour.h"

namespace seldinger::imaging {

// Numbers of colours, in the place of grey: 0 where grey shows, then the box's edge, then speeds from away to
// towards; with a bar of them in the upper right corner.
constexpr unsigned char kNoColour = 0, kColourEdge = 1, kColourStill = 128;
constexpr int kColourSteps = 126;  // to either side of still

// Where a box's cells lie on a converter's screen: made once, so that a picture costs what flows in it.
class ColourScreen {
 public:
  ColourScreen(const ScanConverter& converter, const ColourBox& box, int rows);
  bool is_of(const ColourPicture& colour) const noexcept;  // of the same box and rows
  void numbers(const UltrasoundKnobs& knobs, const ColourPicture& colour,
               std::vector<unsigned char>& numbers) const;  // it is_of (CHECKed)

 private:
  struct Pixel {
    std::uint32_t at;
    float across, down;  // of the way to the next beam and the next row
  };
  std::size_t at(int column, int row) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px_) + static_cast<std::size_t>(column);
  }
  int width_px_, height_px_;
  ColourBox box_;
  int rows_;
  std::vector<Pixel> pixels_;         // cell by cell
  std::vector<std::uint32_t> first_;  // of each cell's, and the end of the last's
  std::vector<std::uint32_t> edge_;   // pixels
};
// By the screen that is kept, made anew where the box is another's; whoever keeps it drops it with the converter.
void colour_numbers(std::optional<ColourScreen>& kept, const ScanConverter& converter, const UltrasoundKnobs& knobs,
                    const ColourPicture& colour, std::vector<unsigned char>& numbers);
// For one picture.
void colour_numbers(const ScanConverter& converter, const UltrasoundKnobs& knobs, const ColourPicture& colour,
                    std::vector<unsigned char>& numbers);
// Red, green, blue of each number: towards the probe red to yellow, away blue to cyan.
const std::array<std::array<unsigned char, 3>, 256>& colour_table() noexcept;
// Three bytes a pixel; `numbers` as large as `grey`.
std::vector<unsigned char> in_colour(std::span<const unsigned char> grey, std::span<const unsigned char> numbers);

}  // namespace seldinger::imaging
