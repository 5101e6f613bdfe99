#include "session/guidance/fluoroscopy.h"

#include <algorithm>
#include <optional>

#include "session/guidance/frame_truth.h"
#include "sim/base/check.h"
#include "sim/case/c_arm.h"
#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/c_arm.h"
#include "sim/imaging/xray/contrast.h"
#include "sim/imaging/xray/enhanced.h"
#include "sim/imaging/xray/exposure.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/imaging/xray/live_picture.h"
#include "sim/imaging/xray/picture.h"
#include "sim/imaging/xray/projection/moved_volume.h"
#include "sim/imaging/xray/projection/projection.h"
#include "sim/imaging/xray/visibility.h"

namespace seldinger::session {
namespace {

// Metering and visibility need no more pixels than these, and are quick with them.
constexpr int kMeterPx = 64;

// Needles are where hands are, lesions where tissue has taken them.
imaging::Inserted inserted_of(const cases::Case& scene, const cases::NeedleState& needle,
                              const tissue::Displacement& displacement) {
  imaging::Inserted inserted;
  inserted.lesions = scene.lesions;
  if (tissue::count_sources(displacement) > 0)
    for (cases::Lesion& lesion : inserted.lesions)
      lesion.center_lps_mm = tissue::displaced(displacement, lesion.center_lps_mm);
  inserted.needle = imaging::needle_pose(scene.instrument, needle.tip_lps_mm, needle.direction);
  return inserted;
}

// Earlier laws of sight take every CT for one of 120 kV without contrast medium.
double ct_kev_of(const cases::Case& scene) {
  return scene.sight_law >= cases::SightLaw::material ? imaging::ct_effective_kev(scene.ct_tube_kv)
                                                      : imaging::kHuEnergyKev;
}

std::unique_ptr<imaging::Enhancement> enhancement_of(const cases::Case& scene) {
  if (scene.sight_law < cases::SightLaw::material) return nullptr;
  auto enhancement = std::make_unique<imaging::Enhancement>(scene);
  return enhancement->any() ? std::move(enhancement) : nullptr;
}

}  // namespace

struct FluoroscopySight::Parts {
  explicit Parts(const cases::Case& case_of_sight)
      : scene(case_of_sight),
        projector(scene.volume),
        moved(scene.volume),
        contrast(scene.volume, tissue::Lumens(scene)),
        enhancement(enhancement_of(scene)),
        live(scene.volume, projector),
        beams(scene.fluoroscope, {}, {ct_kev_of(scene), enhancement != nullptr}),
        automatic(scene.fluoroscope) {
    if (enhancement) live.take_patient(scene.volume, projector, enhancement->at_rest());
  }

  const cases::Case& scene;
  imaging::XrayCpu projector;
  imaging::MovedVolume moved;
  imaging::ContrastMedium contrast;
  std::unique_ptr<imaging::Enhancement> enhancement;  // null: the CT is not enhanced
  std::uint64_t moves = 0;                            // how often `moved` changed
  imaging::LivePicture live;
  std::uint64_t live_tissue = 0;  // Tissue::version of what is in it
  imaging::Beams beams;
  imaging::AutomaticExposure automatic;
  imaging::PanelFlaws flaws;
  // The patient without instruments, where the arm stood last.
  std::uint64_t metered_tissue = 0;
  std::optional<cases::CArm> metered_arm;
  int metered_magnification = 0;
  imaging::PathLengths metered, metered_iodine;
  imaging::PathLengths metered_patient;  // where the CT is enhanced: with iodine told from mineral

  imaging::XrayGeometry geometry(const cases::FluoroscopyState& machine, int size_px) const {
    return imaging::c_arm_geometry(scene.fluoroscope, machine.arm, machine.magnification, size_px, scene.position);
  }

  // What is projected. A patient who lies still is the volume itself, and its version 0.
  struct Tissue {
    const volume::Volume& volume;
    const imaging::XrayCpu& projector;
    std::optional<imaging::EnhancedTissue> enhanced{};  // what of it is iodine
    std::uint64_t version = 0;
  };
  Tissue tissue_in(const imaging::XrayGeometry& beam, const tissue::Displacement& displacement) {
    Tissue tissue{scene.volume, projector};
    if (tissue::count_sources(displacement) == 0) {
      if (enhancement) tissue.enhanced = enhancement->at_rest();
      return tissue;
    }
    if (moved.move(displacement, beam)) ++moves;
    Tissue tissue_moved{moved.volume(), moved.projector(), {}, moves};
    if (enhancement) tissue_moved.enhanced = enhancement->moved(displacement, beam);
    return tissue_moved;
  }

  // Of contrast medium on each pixel's ray; empty: there is none.
  std::vector<float> contrast_in(const cases::State& state, const imaging::XrayGeometry& at,
                                 const tissue::Displacement& displacement, int threads) {
    if (!contrast.take(state.flow)) return {};
    return contrast.lengths_mm(at, displacement, threads);
  }

  const imaging::PathLengths& meter_lengths(const cases::FluoroscopyState& machine, const imaging::XrayGeometry& at,
                                            const Tissue& tissue) {
    if (!metered_arm || !(*metered_arm == machine.arm) || metered_magnification != machine.magnification ||
        metered_tissue != tissue.version) {
      imaging::CpuOptions options;
      options.threads = 1;  // it takes less than starting another
      metered = tissue.projector.project(at, imaging::ProjectionMethod::exact, options);
      if (tissue.enhanced) {
        metered_iodine = tissue.enhanced->project(at, options);
        metered_patient = metered;
        imaging::tell_iodine(*tissue.enhanced, at, {}, metered_iodine, metered_patient);
      }
      metered_arm = machine.arm;
      metered_tissue = tissue.version;
      metered_magnification = machine.magnification;
    }
    return metered;
  }

  // What instruments and injected contrast medium scatter is next to nothing.
  imaging::Pulse pulse_of(const cases::FluoroscopyState& machine, const Tissue& tissue) {
    imaging::Pulse pulse{machine.last_technique, machine.arm.sid_mm, machine.magnification, machine.collimator};
    if (scene.sight_law < cases::SightLaw::scatter) return pulse;
    const imaging::PathLengths& lengths = meter_lengths(machine, geometry(machine, kMeterPx), tissue);
    pulse.scatter = imaging::scatter_share(beams, pulse, tissue.enhanced ? metered_patient : lengths);
    return pulse;
  }
};

FluoroscopySight::FluoroscopySight(const cases::Case& scene) : parts_(std::make_unique<Parts>(scene)) {}
FluoroscopySight::~FluoroscopySight() = default;

FluoroscopySight::Exposed FluoroscopySight::expose(const cases::State& state,
                                                   const tissue::Displacement& displacement) {
  const cases::Case& scene = parts_->scene;
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  CHECK(machine.frame_due);
  const cases::BeamFrame frame = cases::beam_frame(scene.fluoroscope, machine.arm, scene.position);
  const imaging::XrayGeometry geometry = parts_->geometry(machine, kMeterPx);
  const imaging::Inserted inserted = inserted_of(scene, state.needle, displacement);
  const Parts::Tissue tissue = parts_->tissue_in(geometry, displacement);
  const imaging::Pulse pulse = parts_->pulse_of(machine, tissue);

  Exposed exposed;
  imaging::PathLengths lengths = parts_->meter_lengths(machine, geometry, tissue);
  imaging::overlay_instruments(tissue.volume, geometry, inserted, imaging::ProjectionMethod::exact, lengths);
  lengths.contrast_mm = parts_->contrast_in(state, geometry, displacement, 1);
  const bool injected = !lengths.contrast_mm.empty();
  if (tissue.enhanced) imaging::tell_iodine(*tissue.enhanced, geometry, inserted, parts_->metered_iodine, lengths);
  // Step decides between this and what is set by hand.
  exposed.report = imaging::meter(parts_->beams, parts_->automatic, pulse, lengths, cases::FluoroscopeInputs{});
  exposed.report.frame = machine.frames;
  exposed.report.hand_in_beam =
      !machine.hand_away &&
      imaging::meets_beam(
          frame, cases::field_side_mm(scene.fluoroscope, machine.magnification), machine.collimator,
          imaging::hand_at_needle(state.needle.tip_lps_mm, state.needle.direction, scene.instrument.length_mm),
          imaging::kHandRadiusMm);

  const imaging::Visible visible = imaging::xray_visible(
      tissue.volume, geometry, parts_->beams.at(machine.last_technique.kv), pulse, inserted,
      injected ? &parts_->contrast.shown() : nullptr, tissue.enhanced ? &*tissue.enhanced : nullptr);
  exposed.truth = frame_truth(state.t_s, visible);
  exposed.truth.beam = cases::BeamTruth{machine.arm.lao_deg,
                                        machine.arm.cranial_deg,
                                        machine.last_technique.kv,
                                        machine.last_technique.ma,
                                        exposed.report.air_kerma_mgy,
                                        exposed.report.dap_mgy_cm2,
                                        machine.collimator.shut_share(),
                                        machine.frame_s,
                                        machine.arm_moving,
                                        exposed.report.hand_in_beam};

  const auto place = [&](const glm::dvec3& point_lps_mm, glm::dvec2& place_mm) {
    const auto shadow = cases::shadow_of(frame, point_lps_mm);
    if (!shadow) return false;
    place_mm = shadow->detector_mm;
    return cases::inside_field(scene.fluoroscope, machine.magnification, machine.collimator, place_mm);
  };
  exposed.fix.tip = place(state.needle.tip_lps_mm, exposed.fix.tip_mm);
  if (const auto target = target_of(inserted.lesions)) exposed.fix.target = place(*target, exposed.fix.target_mm);
  exposed.fix.target_clear = visible.target;
  return exposed;
}

void FluoroscopySight::set_panel(imaging::Panel panel) {
  parts_->flaws = imaging::flaws_of(panel);
}

GreyPicture FluoroscopySight::picture(const cases::State& state, std::uint64_t seed,
                                      const tissue::Displacement& displacement) {
  const cases::Case& scene = parts_->scene;
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  imaging::PictureSettings settings;
  settings.seed = seed;
  settings.frame = machine.frames;
  settings.t_s = state.t_s;
  settings.flaws = parts_->flaws;
  const imaging::XrayGeometry geometry = parts_->geometry(machine, scene.fluoroscope.picture_px);
  const Parts::Tissue tissue = parts_->tissue_in(geometry, displacement);
  if (tissue.version != parts_->live_tissue)
    parts_->live.take_patient(tissue.volume, tissue.projector, tissue.enhanced);
  parts_->live_tissue = tissue.version;
  const imaging::FluoroscopyPicture& picture = parts_->live.expose(
      geometry, machine.arm_moving, inserted_of(scene, state.needle, displacement),
      parts_->contrast_in(state, geometry, displacement, settings.threads),
      parts_->beams.at(machine.last_technique.kv), parts_->beams.detector(),
      cases::field_side_mm(scene.fluoroscope, machine.magnification), parts_->pulse_of(machine, tissue), settings);
  return {picture.grey, picture.width_px, picture.height_px};
}

}  // namespace seldinger::session
