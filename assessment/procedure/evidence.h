// What an attempt's recording tells about what was done, as far as steps of a procedure ask: each a moment, or
// never.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "assessment/signals/needs.h"

namespace seldinger::assessment {

struct Signals;

enum class Evidence : std::uint8_t {
  none,  // never asked
  // Said or asked for: is_said().
  signed_in,
  decided,  // to proceed or to defer
  deferred,
  probe_checked,
  plan_noted,
  anaesthetised,
  anaesthetised_unaspirated,
  nicked,
  introducer_used,
  breath_hold_asked,
  signed_out,
  // Answered by the patient.
  skin_pain,
  bone_pain,
  // Of the hands.
  probe_on_skin,
  orientation_tested,
  needle_at_skin,
  punctured,
  angle_kept,
  jiggled,
  at_target,
  stylet_exchanged,
  fired_on_stylet,
  at_planned_depth,
  fired,
  needle_out,
  went_on_in_trouble,
  stopped_in_trouble,
  pushed_in_hold,
  pushed_in_breath,
  fired_in_breath,
  // Of the pictures.
  target_seen,
  depth_measured,
  tip_seen,
  both_seen,
  blind_run,
  beyond_plane,
  fired_unseen,
  seen_in_breath_hold,
  on_unchecked,
  unseen_in_breath_hold,
  found_again,
  on_unfound,
  scanned_after,
  // Of the beam.
  target_under_beam,
  looked_along_needle,
  looked_across_needle,
  hand_in_beam,
};

// Nobody knows whether what was said was also done; everything else was done, or answered by the patient.
constexpr bool is_said(Evidence evidence) noexcept {
  return evidence >= Evidence::signed_in && evidence <= Evidence::signed_out;
}

struct EvidenceInfo {
  Evidence evidence;
  const char* words;  // how it is told from the recording
  Needs needs;        // Need, or-ed: without one nothing can be said
  std::optional<double> (*first_s)(const Signals&);
};

std::span<const EvidenceInfo> evidence();

// When it was seen first; never, or cannot be said: nothing. `unmet` as unmet_needs() says.
std::optional<double> first_s(Evidence evidence, const Signals& signals, Needs unmet);
const EvidenceInfo& about(Evidence evidence);

}  // namespace seldinger::assessment
