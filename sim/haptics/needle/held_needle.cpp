#include "sim/haptics/needle/held_needle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::haptics {
namespace {

// Of tissue ahead of the tip, this is looked up when less than half of it is left; at 200 mm/s every 50 ticks.
constexpr double kAheadMm = 20.0;
// While the line follows the hand: at 200 mm/s it has moved 1.6 mm by then, about a voxel.
constexpr int kTicksBetweenLooks = 8;
// A needle that comes back this near to a hole and to its direction, about 8°, goes in again there (design).
constexpr double kSameHoleMm = 2.0, kSameHoleCosine = 0.99;
// Flatter to the skin than 14.5°, or 78° off its own track, it counts as just that (design): both divide by it.
constexpr double kFlattest = 0.25, kMostTurned = 0.2;

// A nick is the prick of a pointed blade, 3 to 5 mm long, through the skin: a disc, as nobody says which way it is
// cut; and its edge, over which the skin holds again (design).
constexpr double kNickRadiusMm = 2.0, kNickEdgeMm = 2.0;

double length(const glm::dvec3& v) noexcept {
  return std::sqrt(glm::dot(v, v));
}

cases::Gauge gauge_of(const cases::Instrument& instrument) {
  return {0, 2.0 * instrument.radius_mm, 2.0 * instrument.inner_radius_mm};
}

// Bone ahead does not give way: tissue is pushed no further than up to it.
double pushed_mm(const HeldNeedleState& state) noexcept {
  const auto path = state.path.span();
  double to_mm = state.depth_mm;
  for (std::size_t ahead = state.track.opened; ahead < path.size(); ++ahead)
    if (path[ahead].tissue.impenetrable) to_mm = std::min(to_mm, path[ahead].start_mm);
  return std::max(0.0, to_mm - state.track.cut_mm);
}

// What lies in an organ is of it.
bool lies_in_organ(volume::TissueClass tissue) noexcept {
  return static_cast<std::size_t>(tissue) >= volume::kTissueClasses || tissue == volume::TissueClass::vessel ||
         tissue == volume::TissueClass::fluid;
}
bool is_organ(volume::TissueClass tissue) noexcept {
  return tissue == volume::TissueClass::liver || tissue == volume::TissueClass::kidney ||
         tissue == volume::TissueClass::spleen;
}

// The organ that the tip is in takes its force; else one whose capsule it presses on.
void press_organ(const NeedleForce& along, const HeldNeedleState& state, tissue::NeedleDrag& drag) noexcept {
  const NeedlePath& path = state.path;
  std::size_t in = state.track.opened;
  while (in > 0 && lies_in_organ(path.tissues[in - 1])) --in;
  if (in > 0 && is_organ(path.tissues[in - 1])) {
    drag.organ = path.tissues[in - 1];
    drag.organ_n = along.tip_n;
  } else if (state.track.opened < path.count && is_organ(path.tissues[state.track.opened])) {
    drag.organ = path.tissues[state.track.opened];
    drag.organ_n = along.capsule_n;
  }
}

void leave(HeldNeedleState& state) noexcept {
  // A hole stays where it is; a dent does not.
  if (state.track.opened == 0) state.track = {};
  state.track.shaft_n = state.track.falling_n = 0.0;
  state.side = {};
  interrupt(state);
  state.outside = true;
}

}  // namespace

void interrupt(HeldNeedleState& state) noexcept {
  state.track.begun = state.side.begun = false;
  state.track.damper_n = 0.0;
  state.side.damper_n = {};
}

namespace {

// Cases of before decision 0061 had plain spheres that no needle felt.
std::span<const cases::Lesion> felt_lesions(const cases::Case& scene) {
  if (scene.sight_law == cases::SightLaw::half_slice) return {};
  return scene.lesions;
}

}  // namespace

HeldNeedle::HeldNeedle(const cases::Case& scene)
    : scene_(&scene),
      needle_{gauge_of(scene.instrument), scene.touch},
      introducer_(introducer_for(needle_)),
      along_needle_(scene.volume, scene.classes, needle_.gauge, felt_lesions(scene), needle_.touch),
      along_introducer_(scene.volume, scene.classes, introducer_.gauge, felt_lesions(scene), introducer_.touch) {}

const FeltNeedle& HeldNeedle::felt(Introducer introducer) const noexcept {
  return introducer == Introducer::closed ? introducer_ : needle_;
}

void HeldNeedle::exchange(Introducer introducer, HeldNeedleState& state) const noexcept {
  if (introducer == state.introducer) return;
  for (std::size_t i = 0; i < state.path.count; ++i) {
    NeedleTissue& tissue = state.path.layers[i].tissue;
    tissue = felt_instead(tissue, felt(state.introducer), felt(introducer));
  }
  // It stays as deep as it has cut its way.
  state.track.sheath_mm =
      introducer == Introducer::open ? inserted_mm(state.path.span(), state.depth_mm, state.track) : 0.0;
  state.track.exchanged = true;
  state.introducer = introducer;
}

double skin_share(const glm::dvec3& p_lps_mm, std::span<const glm::dvec3> nicks_lps_mm) noexcept {
  double share = 1.0;
  for (const glm::dvec3& nick : nicks_lps_mm)
    share = std::min(share, (length(p_lps_mm - nick) - kNickRadiusMm) / kNickEdgeMm);
  return std::max(0.0, share);
}

// Along the needle from the undeformed skin to the tip. Continuous: no ray's miss makes it jump.
double HeldNeedle::below_skin_mm(const cases::ToolPose& pose, const cases::SkinPassage& skin) const noexcept {
  const double most_mm = std::max(0.0, skin.depth_mm) / kFlattest;
  const auto hit = scene_->skin_index.first_hit(pose.position_lps_mm, -pose.axis, most_mm);
  return hit ? hit->distance_mm : most_mm;
}

HeldNeedleForce HeldNeedle::advance(const cases::ToolPose& pose, const NeedleLaw& law,
                                    const NeedleSideLaw& side_law, std::span<const glm::dvec3> nicks_lps_mm,
                                    HeldNeedleState& state) const noexcept {
  const glm::dvec3& tip_lps_mm = pose.position_lps_mm;
  const TissueAlongNeedle& tissue = state.introducer == Introducer::closed ? along_introducer_ : along_needle_;
  const double on_line_mm = glm::dot(tip_lps_mm - state.entry_lps_mm, state.direction);
  // In its track, it is in the body: the skin, costly to ask from deep below, is asked again at the hole.
  const bool in_track = !state.outside && state.track.opened > 0 && on_line_mm > 0.0;
  if (!state.begun)
    state.skin = cases::start_passage(scene_->skin_index, tip_lps_mm, pose.axis);
  else if (!in_track)
    cases::advance_passage(scene_->skin_index, tip_lps_mm, state.skin);
  state.begun = true;
  const bool in_body = state.skin.in_body;
  state.drag = {};
  if (!state.free && in_body) return {};
  state.free = true;
  if (!in_body && !in_track) {
    if (!state.outside) leave(state);
    state.depth_mm = 0.0;
    return {};
  }
  if (state.outside) {
    const bool same_hole = state.track.opened > 0 && length(tip_lps_mm - state.entry_lps_mm) < kSameHoleMm &&
                           glm::dot(pose.axis, state.direction) > kSameHoleCosine;
    if (!same_hole) {
      state.track = {};
      state.track.begun = true;  // from no dent and no force
      state.ticks_to_look = 0;
    }
    state.outside = false;
  }

  if (state.track.opened == 0) {
    state.direction = pose.axis;
    state.depth_mm = below_skin_mm(pose, state.skin);
    state.entry_lps_mm = tip_lps_mm - state.depth_mm * pose.axis;
    if (--state.ticks_to_look <= 0) {
      state.path.count = 0;
      tissue.look(state.entry_lps_mm, state.direction, kAheadMm, 0.0, state.track, state.path);
      state.ticks_to_look = kTicksBetweenLooks;
      state.looked_mm = 0.0;  // of another line than the one that opens
    }
    if (!nicks_lps_mm.empty()) {
      const double share = skin_share(state.entry_lps_mm, nicks_lps_mm);
      NeedleTissue& skin = state.path.layers[0].tissue;
      skin.rupture_n = share * tissue.skin().rupture_n;
      skin.intercept_n = share * tissue.skin().intercept_n;
    }
  } else {
    state.depth_mm = on_line_mm;
    const double reached_mm = std::max(state.depth_mm, state.track.cut_mm);
    if (reached_mm + 0.5 * kAheadMm > state.looked_mm) {
      state.looked_mm = reached_mm + kAheadMm;
      tissue.look(state.entry_lps_mm, state.direction, state.looked_mm, state.depth_mm, state.track, state.path);
    }
  }

  HeldNeedleForce force;
  force.along = law.advance(state.path.span(), state.depth_mm, state.track);
  const double turned = std::max(glm::dot(pose.axis, state.direction), kMostTurned);
  glm::dvec3 shift_mm = tip_lps_mm - state.depth_mm / turned * pose.axis - state.entry_lps_mm;
  shift_mm -= glm::dot(shift_mm, state.direction) * state.direction;
  const double in_tissue_mm = inserted_mm(state.path.span(), state.depth_mm, state.track);
  // What drags begins where a sheath ends.
  state.drag = {.entry_lps_mm = state.entry_lps_mm + state.track.sheath_mm * state.direction,
                .direction = state.direction,
                .radius_mm = 0.5 * felt(state.introducer).gauge.outer_mm,
                .cut_mm = std::min(state.track.cut_mm, state.depth_mm) - state.track.sheath_mm,
                .tip_n = force.along.tip_n,
                .tip_mm = pushed_mm(state),
                .shaft_mm = law.dragged_mm(in_tissue_mm, state.track)};
  press_organ(force.along, state, state.drag);
  force.force_n = side_law.advance(shift_mm, in_tissue_mm, state.side) - force.along.axial_n * state.direction;
  return force;
}

}  // namespace seldinger::haptics
