#include "sim/imaging/ultrasound/colour.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <optional>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

// Of the picture: how much of it the box takes.
constexpr double kBoxWidth = 0.84, kBoxTop = 0.08, kBoxBottom = 0.92;
constexpr double kPlacedShare = 0.4;  // of one that was put somewhere, of the picture's width and depth
constexpr int kBoxRows = 200;

// Blood drowns later than in the grey picture: colour sends longer pulses of lower frequency, many to a place
// (design).
constexpr double kColourNoiseDb = kReceiverNoiseDb - 30.0, kColourSureDb = 6.0;
constexpr double kColourShown = 0.5;  // from so sure a cell on

constexpr int kBarPx = 14, kBarHeightPx = 160, kBarInsetPx = 10;

// A picture's cells, and what lies between four of them.
class Cells {
 public:
  explicit Cells(const ColourPicture& colour)
      : colour_(colour), beams_(colour.box.end_beam - colour.box.first_beam), flows_(colour.cells.size(), 0) {
    for (int b = 0; b + 1 < beams_; ++b)
      for (int k = 0; k + 1 < colour.rows; ++k)
        for (const int place : {at(b, k), at(b + 1, k), at(b, k + 1), at(b + 1, k + 1)})
          if (cell(place) != glm::vec2(0.0F)) flows_[static_cast<std::size_t>(at(b, k))] = 1;
  }
  // `beam` and `row` count from the first's. Nothing where nothing flows, as nearly everywhere.
  std::optional<glm::dvec2> between(double beam, double row) const {
    const int b = std::min(static_cast<int>(beam), beams_ - 2),
              k = std::min(static_cast<int>(row), colour_.rows - 2);
    if (flows_[static_cast<std::size_t>(at(b, k))] == 0) return std::nullopt;
    const auto of = [&](int place) { return glm::dvec2(cell(place)); };
    return glm::mix(glm::mix(of(at(b, k)), of(at(b + 1, k)), beam - b),
                    glm::mix(of(at(b, k + 1)), of(at(b + 1, k + 1)), beam - b), row - k);
  }

 private:
  int at(int beam, int row) const { return beam * colour_.rows + row; }
  const glm::vec2& cell(int place) const { return colour_.cells[static_cast<std::size_t>(place)]; }
  const ColourPicture& colour_;
  int beams_;
  std::vector<unsigned char> flows_;  // in one of a cell, the next beam's and those below them
};

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

double most_colour_mm_s(const UltrasoundView& view) noexcept {
  const double speed_mm_s = 1e6 * shaders::kUsSpeedMmPerUs;
  return speed_mm_s * speed_mm_s / (8.0 * 1e6 * working_mhz(view) * view.depth_mm);
}

double colour_scale_mm_s(const UltrasoundView& view, double asked_mm_s) noexcept {
  return std::clamp(asked_mm_s, kLeastColourMmS, std::max(kLeastColourMmS, most_colour_mm_s(view)));
}

double aliased_mm_s(double towards_mm_s, double scale_mm_s) noexcept {
  const double turns = towards_mm_s / (2.0 * scale_mm_s);
  return 2.0 * scale_mm_s * (turns - std::floor(turns + 0.5));
}

double past_wall_filter(double aliased_mm_s, double scale_mm_s) noexcept {
  const double share = aliased_mm_s / (kColourWallShare * scale_mm_s);
  return share * share / (1.0 + share * share);
}

double most_lean_deg(const UltrasoundView& view) noexcept {
  return view.probe.radius_mm > 0.0 ? 0.0 : kMostLeanDeg;
}

ColourBox colour_box(const UltrasoundView& view, const cases::ConsoleSetting& asked) noexcept {
  const int beside = static_cast<int>(0.5 * (1.0 - kBoxWidth) * view.beams);
  ColourBox box{beside, view.beams - beside, kBoxTop * view.depth_mm, kBoxBottom * view.depth_mm};
  if (asked.box_across > 0.0 && asked.box_down > 0.0) {
    const double half = 0.5 * kPlacedShare;
    const double across = std::clamp(asked.box_across, half, 1.0 - half),
                 down = std::clamp(asked.box_down, half, 1.0 - half);
    box.first_beam = static_cast<int>(std::lround((across - half) * view.beams));
    box.end_beam = std::max(box.first_beam + 2, static_cast<int>(std::lround((across + half) * view.beams)));
    box.from_mm = (down - half) * view.depth_mm;
    box.to_mm = (down + half) * view.depth_mm;
  }
  box.lean_deg = std::clamp(asked.lean_deg, -most_lean_deg(view), most_lean_deg(view));
  if (box.lean_deg != 0.0) {
    const double rad = box.lean_deg * std::numbers::pi / 180.0;
    box.beams_per_mm = base::exact_sin(rad) / base::exact_cos(rad) / fan_of(view).beam_step;
  }
  return box;
}

void colour_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                  std::span<const float> depth_below_skin_mm, const tissue::BloodFlow& flow,
                  const cases::ConsoleSetting& asked, double t_s, ColourPicture& picture,
                  const tissue::Displacement& displacement) {
  check_view(view, depth_below_skin_mm);
  picture.box = colour_box(view, asked);
  picture.rows = kBoxRows;
  picture.scale_mm_s = colour_scale_mm_s(view, asked.colour_mm_s);
  const ColourBox& box = picture.box;
  picture.cells.assign(static_cast<std::size_t>(box.end_beam - box.first_beam) * kBoxRows, glm::vec2(0.0F));
  if (flow.empty()) return;
  const TissueAt tissue_at(tissue, inserted);
  const Fan fan = fan_of(view);
  const auto motion = motion_of(view, displacement, PictureMotion::Asides::left_out);
  const PictureMotion* moving = motion ? &*motion : nullptr;
  const LineWalker walker(view, tissue_at, *tissue.volume, inserted, moving);
  const double blood_db = acoustic_table()[static_cast<std::size_t>(volume::TissueClass::vessel)].scatter_db;
  const double row_mm = (box.to_mm - box.from_mm) / kBoxRows;
  // What grey's beams meet, as far as it is asked for; one that leans goes from each to the next.
  std::vector<std::optional<BeamPath>> paths(static_cast<std::size_t>(view.beams));
  std::vector<Line> lines(static_cast<std::size_t>(view.beams));
  const auto rest_on = [&](int beam, double depth_mm) {
    auto& path = paths[static_cast<std::size_t>(beam)];
    if (!path) path = path_of(fan, moving, beam);
    return path->at(depth_mm);
  };
  const double lean = box.lean_deg * std::numbers::pi / 180.0;
  for (int beam = box.first_beam; beam < box.end_beam; ++beam) {
    const double from = box.grey_beam(beam, 0.0);
    if (!(from >= 0.0 && from <= view.beams - 1.0) || !beam_touches(view, depth_below_skin_mm, from)) continue;
    const glm::dvec3 direction =
        lean == 0.0 ? fan.direction(beam) : base::exact_cos(lean) * fan.axial + base::exact_sin(lean) * fan.lateral;
    for (int row = 0; row < kBoxRows; ++row) {
      const double depth_mm = box.from_mm + (row + 0.5) * row_mm, at = box.grey_beam(beam, depth_mm);
      if (!(at >= 0.0 && at <= view.beams - 1.0)) continue;
      const int near = static_cast<int>(at);
      const glm::dvec3 rest = at == near
                                  ? rest_on(near, depth_mm)
                                  : glm::mix(rest_on(near, depth_mm), rest_on(near + 1, depth_mm), at - near);
      const double towards_mm_s = -glm::dot(flow.velocity_mm_s(rest, t_s), direction);
      if (towards_mm_s == 0.0) continue;
      Line& line = lines[static_cast<std::size_t>(near)];
      if (line.loss_db.empty())
        walker.walk(near, beam_touches(view, depth_below_skin_mm, near), line, LineWalker::Echoes::left_out);
      const auto sample = std::min(static_cast<std::size_t>(depth_mm / fan.sample_mm), line.loss_db.size() - 1);
      const double heard = std::clamp(
          (blood_db - static_cast<double>(line.loss_db[sample]) - kColourNoiseDb) / kColourSureDb, 0.0, 1.0);
      const double speed = aliased_mm_s(towards_mm_s, picture.scale_mm_s);
      const double sure = heard * past_wall_filter(speed, picture.scale_mm_s);
      const double angle = std::numbers::pi * speed / picture.scale_mm_s;
      picture.cells[static_cast<std::size_t>(beam - box.first_beam) * kBoxRows + static_cast<std::size_t>(row)] =
          glm::vec2(sure * base::exact_cos(angle), sure * base::exact_sin(angle));
    }
  }
}

void colour_numbers(const ScanConverter& converter, const UltrasoundKnobs& knobs, const ColourPicture& colour,
                    std::vector<unsigned char>& numbers) {
  const int width = converter.width_px(), height = converter.height_px();
  const int beams = colour.box.end_beam - colour.box.first_beam, rows = colour.rows;
  CHECK(beams > 1 && rows > 1);
  CHECK(colour.cells.size() == static_cast<std::size_t>(beams) * static_cast<std::size_t>(rows));
  const auto at = [&](int c, int r) {
    return static_cast<std::size_t>(r) * static_cast<std::size_t>(width) + static_cast<std::size_t>(c);
  };
  const double row_mm = (colour.box.to_mm - colour.box.from_mm) / rows;
  const Cells cells(colour);
  static const NumberOf number_of;
  numbers.assign(at(0, height), kNoColour);
  std::vector<unsigned char> inside(numbers.size(), 0);
  for (int r = 0; r < height; ++r)
    for (int c = 0; c < width; ++c) {
      const auto place = converter.place(c, r);
      if (!place) continue;
      const double beam = place->beam - colour.box.grey_beam(colour.box.first_beam, place->depth_mm),
                   row = (place->depth_mm - colour.box.from_mm) / row_mm;
      if (beam < 0.0 || beam > beams - 1.0 || row < 0.0 || row > rows) continue;
      inside[at(c, r)] = 1;
      const auto mean = cells.between(beam, std::clamp(row - 0.5, 0.0, rows - 1.0));
      if (!mean) continue;
      const double sure = std::sqrt(mean->x * mean->x + mean->y * mean->y);
      if (sure < kColourShown) continue;
      // Half the angle, whose tangent has no second meaning.
      numbers[at(c, r)] = static_cast<unsigned char>(number_of(mean->y / std::max(sure + mean->x, 1e-12)));
    }
  for (int r = 1; r + 1 < height; ++r) {
    const unsigned char *row = inside.data() + at(0, r), *above = inside.data() + at(0, r - 1),
                        *below = inside.data() + at(0, r + 1);
    unsigned char* number = numbers.data() + at(0, r);
    for (int c = 1; c + 1 < width; ++c) {
      const bool edge = row[c] > (row[c - 1] & row[c + 1] & above[c] & below[c]);
      number[c] = edge ? kColourEdge : number[c];
    }
  }
  if (knobs.flip)
    for (int r = 0; r < height; ++r)
      std::reverse(numbers.begin() + static_cast<std::ptrdiff_t>(at(0, r)),
                   numbers.begin() + static_cast<std::ptrdiff_t>(at(0, r + 1)));
  for (int r = 0; r < std::min(kBarHeightPx, height - kBarInsetPx); ++r)
    for (int c = std::max(0, width - kBarInsetPx - kBarPx); c < width - kBarInsetPx; ++c)
      numbers[at(c, r + kBarInsetPx)] = static_cast<unsigned char>(
          kColourStill + std::lround(kColourSteps * (1.0 - 2.0 * r / (kBarHeightPx - 1.0))));
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
