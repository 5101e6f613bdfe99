#include "sim/imaging/ultrasound/colour.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
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
    for (int row = kBoxRows - 1; row >= 0; --row) {  // the deepest first: a walk to it serves those above
      const double depth_mm = box.from_mm + (row + 0.5) * row_mm, at = box.grey_beam(beam, depth_mm);
      if (!(at >= 0.0 && at <= view.beams - 1.0)) continue;
      const int near = static_cast<int>(at);
      const glm::dvec3 rest = at == near
                                  ? rest_on(near, depth_mm)
                                  : glm::mix(rest_on(near, depth_mm), rest_on(near + 1, depth_mm), at - near);
      const double towards_mm_s = -glm::dot(flow.velocity_mm_s(rest, t_s), direction);
      if (towards_mm_s == 0.0) continue;
      Line& line = lines[static_cast<std::size_t>(near)];
      const auto sample = static_cast<std::size_t>(std::min(depth_mm / fan.sample_mm, view.samples - 1.0));
      if (line.loss_db.size() <= sample)
        walker.walk_down(near, beam_touches(view, depth_below_skin_mm, near), sample + 1, line);
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

}  // namespace seldinger::imaging
