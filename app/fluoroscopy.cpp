#include "app/fluoroscopy.h"

#include "sim/base/check.h"
#include "sim/case/c_arm.h"
#include "sim/imaging/xray/c_arm.h"

namespace seldinger::app {

struct FluoroscopyRoom::Parts {
  const cases::Case& scene;
};

FluoroscopyRoom::FluoroscopyRoom(const cases::Case& scene) : parts_(new Parts{scene}) {}
FluoroscopyRoom::~FluoroscopyRoom() = default;

namespace {

// STAND-IN until the image chain is here: a tube output of 50 µGy/mAs at 1 m and 70 kV, rising with kV², no wedge,
// no automatic exposure.
void meter(const cases::Fluoroscope& machine, const cases::FluoroscopyState& machine_state,
           cases::ExposureReport& report) {
  const cases::Technique& technique = machine_state.last_technique;
  const double mas = technique.ma * technique.pulse_ms / 1000.0, kv = technique.kv / 70.0;
  const double reference_mm = machine.source_isocentre_mm - 150.0;
  report.air_kerma_mgy = 0.05 * mas * kv * kv * (1000.0 / reference_mm) * (1000.0 / reference_mm);
  const double side_cm =
      cases::field_side_mm(machine, machine_state.magnification) * reference_mm / machine_state.arm.sid_mm / 10.0;
  report.dap_mgy_cm2 = report.air_kerma_mgy * side_cm * side_cm * (1.0 - machine_state.collimator.shut_share());
  report.next = technique;
}

}  // namespace

FluoroscopyRoom::Exposed FluoroscopyRoom::expose(const cases::State& state) const {
  const cases::Case& scene = parts_->scene;
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  CHECK(machine.frame_due);
  const cases::BeamFrame frame = cases::beam_frame(scene.fluoroscope, machine.arm, scene.position);
  const auto inside = [&](const cases::Shadow& shadow) {
    return cases::inside_field(scene.fluoroscope, machine.magnification, machine.collimator, shadow.detector_mm);
  };
  Exposed exposed;
  if (const auto tip = cases::shadow_of(frame, state.needle.tip_lps_mm)) {
    exposed.fix.tip_mm = tip->detector_mm;
    exposed.fix.tip = exposed.truth.needle_tip = inside(*tip);
  }
  if (!scene.lesions.empty())
    if (const auto target = cases::shadow_of(frame, scene.lesions[0].center_lps_mm)) {
      exposed.fix.target_mm = target->detector_mm;
      exposed.fix.target = exposed.truth.target = inside(*target);
    }
  exposed.fix.target_clear = exposed.truth.target;

  cases::ExposureReport& report = exposed.report;
  report.frame = machine.frames;
  report.hand_in_beam =
      !machine.hand_away &&
      imaging::meets_beam(
          frame, cases::field_side_mm(scene.fluoroscope, machine.magnification), machine.collimator,
          imaging::hand_at_needle(state.needle.tip_lps_mm, state.needle.direction, scene.instrument.length_mm),
          imaging::kHandRadiusMm);
  meter(scene.fluoroscope, machine, report);

  exposed.truth.t_s = state.t_s;
  exposed.truth.beam = cases::BeamTruth{
      machine.arm.lao_deg,  machine.arm.cranial_deg, machine.last_technique.kv,       machine.last_technique.ma,
      report.air_kerma_mgy, report.dap_mgy_cm2,      machine.collimator.shut_share(), machine.frame_s,
      machine.arm_moving,   report.hand_in_beam};
  return exposed;
}

std::vector<std::byte> FluoroscopyRoom::picture_png(const cases::State&) const {
  return {};  // the renderer comes with the image chain
}

}  // namespace seldinger::app
