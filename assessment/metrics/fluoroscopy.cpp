#include "assessment/metrics/fluoroscopy.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "assessment/signals.h"
#include "sim/case/viewing_angles.h"

namespace seldinger::assessment {
namespace {

constexpr double kMgyPerGy = 1000.0;

// Why there is no answer at all, or null. Poses from a file tell what a picture would have shown, not what the beam
// did.
const char* reason_for_none(const Signals& signals) {
  if (signals.setting.modality != cases::Modality::xray) return "not_xray";
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.live && !frame.beam) return "beam_not_recorded";
  return nullptr;
}

// Sum over the pulses.
template <typename Part>
Measured sum(const Signals& signals, const Part& part) {
  if (const char* reason = reason_for_none(signals)) return Measured::none(reason);
  double total = 0.0;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam) total += part(*frame.beam);
  return Measured::of(total);
}

cases::ViewingAngles viewing_angles(const Signals& signals) {
  cases::ViewingAngles views;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam && !frame.beam->arm_moving) cases::add_view(frame.beam->lao_deg, frame.beam->cranial_deg, views);
  return views;
}

}  // namespace

Measured fluoroscopy_time(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.beam_s; });
}

Measured pulses(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth&) { return 1.0; });
}

Measured pulse_rate_max(const Signals& signals) {
  if (const char* reason = reason_for_none(signals)) return Measured::none(reason);
  double shortest_s = 0.0;
  for (const cases::FrameTruth& frame : signals.frames)
    if (frame.beam && frame.beam->beam_s > 0.0)
      shortest_s = shortest_s > 0.0 ? std::min(shortest_s, frame.beam->beam_s) : frame.beam->beam_s;
  return shortest_s > 0.0 ? Measured::of(1.0 / shortest_s) : Measured::none("no_exposure");
}

Measured dap(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.dap_mgy_cm2 / kMgyPerGy; });
}

Measured air_kerma(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.air_kerma_mgy; });
}

Measured beam_while_moving(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.arm_moving ? beam.beam_s : 0.0; });
}

Measured hand_in_beam(const Signals& signals) {
  return sum(signals, [](const cases::BeamTruth& beam) { return beam.hand_in_beam ? beam.beam_s : 0.0; });
}

Measured collimated_share(const Signals& signals) {
  const Measured time = fluoroscopy_time(signals);
  if (!time.value) return time;
  if (!(*time.value > 0.0)) return Measured::none("no_exposure");
  const Measured shut =
      sum(signals, [](const cases::BeamTruth& beam) { return beam.collimated_share * beam.beam_s; });
  return Measured::of(*shut.value / *time.value);
}

Measured views(const Signals& signals) {
  if (const char* reason = reason_for_none(signals)) return Measured::none(reason);
  return Measured::of(viewing_angles(signals).count);
}

Measured view_angle_max(const Signals& signals) {
  if (const char* reason = reason_for_none(signals)) return Measured::none(reason);
  const cases::ViewingAngles angles = viewing_angles(signals);
  if (angles.count < 2) return Measured::none("fewer_than_two_views");
  return Measured::of(angles.widest_deg);
}

Measured longest_advance_between_exposures(const Signals& signals) {
  if (const char* reason = reason_for_none(signals)) return Measured::none(reason);
  if (signals.setting.skin->empty()) return Measured::none("no_skin");
  if (signals.only_gaps()) return Measured::none("only_gaps");
  bool in_tissue = false;
  double longest_mm = 0.0, lowest_mm = 0.0, last_mm = 0.0;
  std::size_t frame = 0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const cases::SkinPassage& skin = signals.passages[i];
    // Poses are held until the next: an exposure since the one before shows the tip where that one has it.
    bool exposed = false;
    for (; frame < signals.frames.size() && signals.frames[frame].t_s <= signals.poses[i].t_s; ++frame)
      exposed = exposed || signals.frames[frame].beam.has_value();
    if (exposed) lowest_mm = last_mm;
    const double inserted_mm = signals.inserted_mm(i);
    in_tissue = in_tissue || skin.in_body;
    // What starts inside has advanced before anybody looked; what happened in a gap is not known.
    if (i == 0 || signals.gap(i - 1)) lowest_mm = inserted_mm;
    lowest_mm = std::min(lowest_mm, inserted_mm);
    longest_mm = std::max(longest_mm, inserted_mm - lowest_mm);
    last_mm = inserted_mm;
  }
  if (!in_tissue) return Measured::none("never_in_tissue");
  return Measured::of(longest_mm);
}

}  // namespace seldinger::assessment
