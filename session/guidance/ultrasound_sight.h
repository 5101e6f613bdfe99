// What a person sees of a case by ultrasound: from a probe's pose to the picture, and to what is told of it. The
// one place where attempts meet ultrasound imaging.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "assessment/operators/plan.h"
#include "session/guidance/grey_picture.h"
#include "sim/case/case.h"
#include "sim/case/form/mesh_index.h"
#include "sim/case/state.h"
#include "sim/gpu/context.h"
#include "sim/imaging/ultrasound/colour.h"
#include "sim/imaging/ultrasound/ultrasound_gpu.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"
#include "sim/imaging/ultrasound/visible.h"
#include "sim/tissue/blood_flow.h"
#include "sim/tissue/displacement.h"

namespace seldinger::session {

constexpr int kContactStride = 8;  // elements; 4 mm of a curved face, over which skin hardly bends

// How deep below the skin each of the probe's elements lies, mm; an empty skin: all stand in air. Asked of every
// `stride`-th element, between them linear. The skin is where the displacement puts it but for presses: under a
// probe the whole face carries it, of which a press, being a ball's, knows only the middle.
std::vector<float> element_depths(const cases::MeshIndex& skin, const imaging::UltrasoundView& view, int stride = 1,
                                  const tissue::Displacement& displacement = {});

// How a target so deep below the skin, along the probe's axis, is looked at: by the linear probe down to 35 mm,
// else by the curved one, at a depth of which the target lies at 1/2 to 2/3, as fast as sound allows up to the
// screen's 60 Hz.
cases::Picture ultrasound_picture(double target_below_skin_mm);
// Those that are offered where a probe may be chosen: a curved and a linear one.
std::array<const imaging::Probe*, 2> offered_probes() noexcept;
// That picture by another probe, with the target at the same share of its depth.
cases::Picture by_probe(const cases::Picture& picture, const imaging::Probe& probe);

// How often an ultrasound machine makes a picture: as the case says, until a depth is asked for; then as sound
// allows.
double picture_rate_hz(const cases::Picture& picture, const cases::ConsoleSetting& console) noexcept;

// Where the probe is.
inline cases::ToolPose probe_in(const cases::State& state) noexcept {
  return {state.probe.origin_lps_mm, state.probe.axial, state.probe.lateral};
}

// The picture's view as the console stands, without a pose.
imaging::UltrasoundView console_view(const cases::Picture& picture, const cases::ConsoleSetting& console);

// Whether the looks of a compounded picture (sim/imaging/ultrasound/compound.h) are of one moment.
enum class LooksOf { one_moment, last_frames };

class UltrasoundSight {
 public:
  // The scene has its tissue (Needs::ultrasound; CHECK) and outlives it.
  explicit UltrasoundSight(const cases::Case& scene);

  // PathLimits::looks_from, by the picture that ultrasound_picture chooses there, with this target.
  std::optional<assessment::ProbeView> looks_from(const assessment::PuncturePlan& plan,
                                                  const assessment::WorthTaking& worth,
                                                  const cases::Lesion& target) const;

  // In the scene's picture as the console stands, with its lesions, of tissue that is where the displacement puts
  // it.
  imaging::UltrasoundVisible see(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                                 const imaging::NeedlePose& needle,
                                 const tissue::Displacement& displacement = {}) const;
  // What the machine receives there, with its noise; answers how it looked. Of a compounded picture a live machine
  // makes one look, by the frame's number, and shows it with the last two; else all are of this moment. Arteries
  // are as wide as the heart's beat has them at `t_s` of the attempt; what is told (see) does not ask for that.
  imaging::UltrasoundView polar(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                                const imaging::NeedlePose& needle, std::uint64_t seed, std::uint64_t frame,
                                imaging::PolarPicture& picture, const tissue::Displacement& displacement = {},
                                double t_s = 0.0, LooksOf looks = LooksOf::one_moment);
  // What colour Doppler shows over such a picture; nothing while it is off.
  std::optional<imaging::ColourPicture> colour(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                                               const imaging::NeedlePose& needle, double t_s,
                                               const tissue::Displacement& displacement = {}) const;
  // How `polar` makes speckle; scatterers unless it is told.
  void set_method(imaging::UltrasoundMethod method) noexcept { method_ = method; }
  // `polar` is GL's from now on, on the context's thread. Throws base::Failure("gl").
  void draw_on(gpu::Context& context);
  void draw_on_cpu() noexcept { gpu_.reset(); }  // again
  // As the screen shows it, without the empty rows below a wide field. `seed` and `frame` are the receiver's noise;
  // at `t_s` of the attempt, which tells the heart's beat.
  GreyPicture picture(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                      const imaging::NeedlePose& needle, std::uint64_t seed, std::uint64_t frame,
                      const tissue::Displacement& displacement = {}, double t_s = 0.0);

 private:
  struct Screen;      // what pictures need beside the tissue, made with the first
  struct Compounded;  // the last looks of a compounded picture
  // console_view under the scene's law of sight.
  imaging::UltrasoundView view_of(const cases::Picture& picture, const cases::ConsoleSetting& console) const;
  // In pictures: with the pulse, where the scene's law has it (imaging::shows_artefacts).
  tissue::Displacement drawn(const imaging::UltrasoundView& view, const tissue::Displacement& displacement,
                             double t_s) const;
  imaging::UltrasoundVisible see(const imaging::UltrasoundView& view, const imaging::Inserted& inserted,
                                 const tissue::Displacement& displacement) const;

  const cases::Case& scene_;
  imaging::TissueVolume tissue_;
  tissue::BloodFlow flow_;
  std::shared_ptr<Screen> screen_;
  std::shared_ptr<Compounded> compounded_;
  imaging::Clutter clutter_;
  imaging::UltrasoundMethod method_ = imaging::UltrasoundMethod::scatterers;
  std::shared_ptr<imaging::UltrasoundGpu> gpu_;
};

}  // namespace seldinger::session
