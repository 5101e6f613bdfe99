#include "sim/imaging/ultrasound/colour_screen.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::imaging {
namespace {

constexpr double kColourShown = 0.5;  // from so sure a cell on
constexpr int kBarPx = 14, kBarHeightPx = 160, kBarInsetPx = 10;

// The number of a cell's angle, by the tangent of half of it, whose arc tangent takes longer than all else of a
// pixel: from the borders between numbers, of which a bin holds no more than one, and by the arc tangent beside
// one.
class NumberOf {
 public:
  NumberOf() {
    for (int i = 0; i < kBins; ++i) {
      const double share = 2.0 * i / kBins - 1.0;
      const int below = i == 0 ? kColourStill - kColourSteps : by_arc(share / (1.0 - std::abs(share)));
      const double half = (below - kColourStill + 0.5) * std::numbers::pi / (2.0 * kColourSteps);
      bins_[static_cast<std::size_t>(i)] = {below, below == kColourStill + kColourSteps
                                                       ? std::numeric_limits<double>::infinity()
                                                       : base::exact_sin(half) / base::exact_cos(half)};
    }
  }
  int operator()(double tangent) const {
    const double share = tangent / (1.0 + std::abs(tangent));
    const int bin = std::min(static_cast<int>(0.5 * kBins * (share + 1.0)), kBins - 1);
    const Bin& at = bins_[static_cast<std::size_t>(bin)];
    if (std::abs(tangent - at.border) <= 1e-9 * (1.0 + std::abs(tangent))) return by_arc(tangent);
    return at.below + (tangent > at.border ? 1 : 0);
  }
  static int by_arc(double tangent) {
    return kColourStill +
           static_cast<int>(std::lround(kColourSteps * (2.0 / std::numbers::pi * base::exact_atan(tangent))));
  }

 private:
  static constexpr int kBins = 1024;
  struct Bin {
    int below = 0;        // at its lower end
    double border = 0.0;  // to the next number
  };
  std::array<Bin, kBins> bins_;
};

}  // namespace

ColourScreen::ColourScreen(const ScanConverter& converter, const ColourBox& box, int rows)
    : width_px_(converter.width_px()), height_px_(converter.height_px()), box_(box), rows_(rows) {
  const int beams = box.end_beam - box.first_beam;
  CHECK(beams > 1 && rows > 1);
  const double row_mm = (box.to_mm - box.from_mm) / rows;
  std::vector<unsigned char> inside(at(0, height_px_), 0);
  std::vector<Pixel> met;
  std::vector<std::uint32_t> cell_of;
  first_.assign(static_cast<std::size_t>(beams) * static_cast<std::size_t>(rows) + 1, 0);
  for (int r = 0; r < height_px_; ++r)
    for (int c = 0; c < width_px_; ++c) {
      const auto place = converter.place(c, r);
      if (!place) continue;
      const double beam = place->beam - box.grey_beam(box.first_beam, place->depth_mm),
                   below = (place->depth_mm - box.from_mm) / row_mm;
      if (beam < 0.0 || beam > beams - 1.0 || below < 0.0 || below > rows) continue;
      inside[at(c, r)] = 1;
      const double row = std::clamp(below - 0.5, 0.0, rows - 1.0);
      const int b = std::min(static_cast<int>(beam), beams - 2), k = std::min(static_cast<int>(row), rows - 2);
      met.push_back(
          {static_cast<std::uint32_t>(at(c, r)), static_cast<float>(beam - b), static_cast<float>(row - k)});
      cell_of.push_back(static_cast<std::uint32_t>(b * rows + k));
      ++first_[cell_of.back() + 1];
    }
  for (std::size_t cell = 1; cell < first_.size(); ++cell) first_[cell] += first_[cell - 1];
  std::vector<std::uint32_t> next = first_;
  pixels_.resize(met.size());
  for (std::size_t i = 0; i < met.size(); ++i) pixels_[next[cell_of[i]]++] = met[i];
  for (int r = 1; r + 1 < height_px_; ++r)
    for (int c = 1; c + 1 < width_px_; ++c)
      if (inside[at(c, r)] >
          (inside[at(c - 1, r)] & inside[at(c + 1, r)] & inside[at(c, r - 1)] & inside[at(c, r + 1)]))
        edge_.push_back(static_cast<std::uint32_t>(at(c, r)));
}

bool ColourScreen::is_of(const ColourPicture& colour) const noexcept {
  return colour.box == box_ && colour.rows == rows_;
}

void ColourScreen::numbers(const UltrasoundKnobs& knobs, const ColourPicture& colour,
                           std::vector<unsigned char>& numbers) const {
  CHECK(is_of(colour) && colour.cells.size() + 1 == first_.size());
  static const NumberOf number_of;
  numbers.assign(at(0, height_px_), kNoColour);
  const auto rows = static_cast<std::size_t>(rows_);
  for (std::size_t cell = 0; cell + rows + 1 < colour.cells.size(); ++cell) {
    const glm::vec2 *here = colour.cells.data() + cell, *beside = here + rows;
    const glm::vec2 still(0.0F);  // as nearly everywhere
    if (here[0] == still && here[1] == still && beside[0] == still && beside[1] == still) continue;
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i) {
      const Pixel& pixel = pixels_[i];
      const auto across = static_cast<double>(pixel.across), down = static_cast<double>(pixel.down);
      const glm::dvec2 mean = glm::mix(glm::mix(glm::dvec2(here[0]), glm::dvec2(beside[0]), across),
                                       glm::mix(glm::dvec2(here[1]), glm::dvec2(beside[1]), across), down);
      const double sure = std::sqrt(mean.x * mean.x + mean.y * mean.y);
      if (sure < kColourShown) continue;
      // Half the angle, whose tangent has no second meaning.
      numbers[pixel.at] = static_cast<unsigned char>(number_of(mean.y / std::max(sure + mean.x, 1e-12)));
    }
  }
  for (const std::uint32_t pixel : edge_) numbers[pixel] = kColourEdge;
  if (knobs.flip)
    for (int r = 0; r < height_px_; ++r)
      std::reverse(numbers.begin() + static_cast<std::ptrdiff_t>(at(0, r)),
                   numbers.begin() + static_cast<std::ptrdiff_t>(at(0, r + 1)));
  for (int r = 0; r < std::min(kBarHeightPx, height_px_ - kBarInsetPx); ++r)
    for (int c = std::max(0, width_px_ - kBarInsetPx - kBarPx); c < width_px_ - kBarInsetPx; ++c)
      numbers[at(c, r + kBarInsetPx)] = static_cast<unsigned char>(
          kColourStill + std::lround(kColourSteps * (1.0 - 2.0 * r / (kBarHeightPx - 1.0))));
}

void colour_numbers(std::optional<ColourScreen>& kept, const ScanConverter& converter, const UltrasoundKnobs& knobs,
                    const ColourPicture& colour, std::vector<unsigned char>& numbers) {
  if (!kept || !kept->is_of(colour)) kept.emplace(converter, colour.box, colour.rows);
  kept->numbers(knobs, colour, numbers);
}

void colour_numbers(const ScanConverter& converter, const UltrasoundKnobs& knobs, const ColourPicture& colour,
                    std::vector<unsigned char>& numbers) {
  ColourScreen(converter, colour.box, colour.rows).numbers(knobs, colour, numbers);
}

const std::array<std::array<unsigned char, 3>, 256>& colour_table() noexcept {
  static const auto table = [] {
    std::array<std::array<unsigned char, 3>, 256> made{};
    made[kColourEdge] = {150, 190, 150};
    for (int step = -kColourSteps; step <= kColourSteps; ++step) {
      const double share = std::abs(static_cast<double>(step)) / kColourSteps;
      const auto full = static_cast<unsigned char>(std::lround(255.0 * std::min(1.0, 0.4 + 0.9 * share)));
      const auto added = static_cast<unsigned char>(std::lround(230.0 * std::max(0.0, (share - 0.35) / 0.65)));
      auto& one = made[static_cast<std::size_t>(kColourStill + step)];
      if (step > 0) one = {full, added, 0};
      if (step < 0) one = {0, added, full};
    }
    return made;
  }();
  return table;
}

std::vector<unsigned char> in_colour(std::span<const unsigned char> grey, std::span<const unsigned char> numbers) {
  CHECK(grey.size() == numbers.size());
  std::vector<unsigned char> rgb;
  rgb.reserve(3 * grey.size());
  for (std::size_t i = 0; i < grey.size(); ++i)
    for (int channel = 0; channel < 3; ++channel)
      rgb.push_back(numbers[i] == kNoColour ? grey[i]
                                            : colour_table()[numbers[i]][static_cast<std::size_t>(channel)]);
  return rgb;
}

}  // namespace seldinger::imaging
