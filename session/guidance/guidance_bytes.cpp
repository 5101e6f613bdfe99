#include "session/guidance/guidance_bytes.h"

#include "sim/engine/saved_fields.h"
#include "sim/engine/tick_state_fields.h"

namespace seldinger::engine::fields {

SELDINGER_FIELDS(cases::BeamTruth, lao, cranial, kv, ma, kerma, dap, collimated, beam_s, arm_moving, hand_in_beam)
SELDINGER_FIELDS(cases::NearPlane, tip_2, target_2, tip_5, target_5)
SELDINGER_FIELDS(cases::FrameTruth, t, live, tip, target, length, beam, near_plane)
SELDINGER_FIELDS(cases::ExposureReport, frame, kerma, dap, next, hand_in_beam)
SELDINGER_FIELDS(assessment::PictureFix, tip, target, clear, tip_mm, target_mm)
template <typename Each, Is<session::PictureClock> S>
void visit(Each&& each, S& s) {
  session::PictureClock::visit(each, s);
}
SELDINGER_FIELDS(session::GuidanceState, clock, truth, fix, report, moved, fresh, live)

}  // namespace seldinger::engine::fields

namespace seldinger::session {
namespace {

constexpr engine::fields::Mark kMark = {{'S', 'e', 'l', 'd', 'G', 'u', 'i', 'd'}, 1};

}  // namespace

std::vector<std::byte> saved(const GuidanceState& state) {
  return engine::fields::bytes_of(kMark, state);
}

base::Result<GuidanceState> restored_guidance(std::span<const std::byte> bytes) {
  return engine::fields::value_of<GuidanceState>(kMark, bytes);
}

}  // namespace seldinger::session
