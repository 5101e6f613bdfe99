#include "sim/engine/tick_state.h"

#include "sim/engine/saved_fields.h"
#include "sim/engine/tick_state_fields.h"

namespace seldinger::engine {
namespace {

constexpr fields::Mark kMark = {{'S', 'e', 'l', 'd', 'T', 'i', 'c', 'k'}, 7};

// What the laws take as an index must be one, whoever wrote the bytes.
bool usable(const TickState& now) noexcept {
  const auto known = [](cases::EventKind kind) {
    return kind == cases::EventKind::none || cases::find_event(kind) != nullptr;
  };
  const auto known_introducer = [](haptics::Introducer introducer) {
    return static_cast<int>(introducer) >= 0 && static_cast<int>(introducer) < cases::kIntroducers;
  };
  if (!known_introducer(now.introducer)) return false;
  for (const haptics::HandState& hand : now.hands) {
    const haptics::NeedlePath& path = hand.needle.path;
    if (path.count > path.layers.size() || hand.needle.track.opened > path.count) return false;
    if (hand.delay_ticks < 0 || hand.delay_ticks > haptics::kMostDelayTicks) return false;
    if (!known_introducer(hand.needle.introducer)) return false;
    if (static_cast<int>(hand.tool) < 0 || static_cast<int>(hand.tool) >= haptics::kTools) return false;
    for (const volume::TissueClass tissue : path.tissues)
      if (static_cast<std::size_t>(tissue) >= volume::kTissueClasses + haptics::kMostFeltLesions) return false;
  }
  for (const cases::EventKind kind : now.patient.waiting)
    if (!known(kind)) return false;
  const cases::NeedleFlow& flow = now.state.flow;
  for (const cases::LumenContent content : {flow.column, flow.at_hub, flow.aspirated, now.patient.returned})
    if (content > cases::LumenContent::fluid) return false;
  const tissue::Displacement& moved = now.displacement;
  if (moved.contact_end < 0 || moved.tip_end < moved.contact_end || moved.shaft_end < moved.tip_end ||
      moved.organ_end < moved.shaft_end || moved.vein_end < moved.organ_end || moved.breath_end < moved.vein_end ||
      moved.breath_end > shaders::kMostDisplacementSources)
    return false;
  const cases::FluoroscopyState& machine = now.state.fluoroscopy;
  const auto rates = static_cast<int>(cases::kPulseRateHz.size());
  const auto sizes = static_cast<int>(cases::Fluoroscope{}.field_side_mm.size());
  return known(now.reaction.kind) && known(now.event.kind) && machine.views.count >= 0 &&
         machine.views.count <= cases::kMaxViews && machine.pulse_rate >= 0 && machine.pulse_rate < rates &&
         machine.magnification >= 0 && machine.magnification < sizes;
}

}  // namespace

std::uint64_t tick_state_hash(const TickState& now) noexcept {
  return fields::hash_of(now);
}

std::vector<std::byte> saved(const TickState& now) {
  return fields::bytes_of(kMark, now);
}

base::Result<TickState> restored(std::span<const std::byte> bytes) {
  auto now = fields::value_of<TickState>(kMark, bytes);
  if (now && !usable(*now)) return base::Error{"damaged", "a saved state of an attempt holds what it cannot"};
  return now;
}

}  // namespace seldinger::engine
