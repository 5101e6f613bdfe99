// What guides an attempt: the pictures of one modality, what they show and what they cost. guidance_kind is the one
// place that tells modalities apart; attempts, replays and screens ask this interface.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "assessment/operators/fluoroscopy.h"
#include "assessment/operators/plan.h"
#include "session/guidance/grey_picture.h"
#include "session/guidance/guidance_needs.h"
#include "session/guidance/picture_clock.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"
#include "sim/case/state.h"
#include "sim/imaging/inserted.h"
#include "sim/tissue/displacement.h"

namespace seldinger::session {

class ScreenPainter;
enum class PicturesBy;

// All of a guidance that a later tick or frame depends on: saved and restored with engine::TickState an attempt
// goes on as if it had not stopped. Everything else that a Guidance holds it makes again from its case.
struct GuidanceState {
  PictureClock clock{};            // under a probe: when the next picture is due
  cases::FrameTruth truth{};       // what the last picture showed,
  assessment::PictureFix fix{};    // and where, under a fluoroscope
  cases::ExposureReport report{};  // what the last pulse cost: an input of every tick from then on
  glm::dvec3 moved_mm{0.0};        // how far tissue had taken the target in the last picture, under a probe
  bool fresh = false;              // the last picture came with the last tick
  bool live = false;               // neither frozen nor held, when it was last asked for
  bool operator==(const GuidanceState&) const = default;
};

// What makes a picture's noise: the attempt's seed, and the picture's number in it.
struct PictureNoise {
  std::uint64_t seed = 0, number = 0;
};

// Used by one thread at a time.
class Guidance {
 public:
  // `scene`, with what its modality needs (needs_of), must outlive it.
  explicit Guidance(const cases::Case& scene) : scene_(scene) {}
  virtual ~Guidance() = default;
  Guidance(const Guidance&) = delete;
  Guidance& operator=(const Guidance&) = delete;

  const GuidanceState& state() const noexcept { return state_; }
  void restore(const GuidanceState& state) { state_ = state; }

  // Each pulse of the machine makes a picture (FluoroscopyState::frame_due); else pictures have a rate.
  virtual bool pulsed() const noexcept = 0;
  // How often to look for a new picture while the console stands so.
  virtual double rate_hz(const cases::ConsoleSetting& console) const noexcept = 0;
  // Pictures follow what happens: they are neither frozen nor a held last image.
  virtual bool live(const cases::State& state) const noexcept = 0;

  // In virtual time, asked once after each tick: whether a new picture belongs to it.
  virtual bool due(const cases::State& state) = 0;
  // A new picture of this moment (of a pulsed machine: frame_due, CHECKed): what it shows. What it cost is in
  // state().
  const cases::FrameTruth& see(const cases::State& state, const tissue::Displacement& displacement);
  // No new picture. A pulsed machine's last image stays, and shows nothing that happens: told once, when the
  // pulse's time is over.
  std::optional<cases::FrameTruth> stay(const cases::State& state);
  // A whole tick of virtual time: the frame that a recording keeps of it, if any.
  std::optional<cases::FrameTruth> follow(const cases::State& state, const tissue::Displacement& displacement) {
    return due(state) ? see(state, displacement) : stay(state);
  }

  // The picture of such a moment, as the screen shows it.
  virtual GreyPicture picture(const cases::State& state, const tissue::Displacement& displacement,
                              const PictureNoise& noise) = 0;

  // What paints them for a person who acts. `by`: by the GPU on a context of its own, and by the CPU where there is
  // none.
  virtual std::unique_ptr<ScreenPainter> painter(std::uint64_t seed, PicturesBy by) const = 0;

 protected:
  // Into state_: what a new picture shows, where, and what it cost.
  virtual void look(const cases::State& state, const tissue::Displacement& displacement) = 0;

  imaging::NeedlePose needle_in(const cases::State& state) const noexcept {
    return imaging::needle_pose(scene_.instrument, state.needle.tip_lps_mm, state.needle.direction);
  }

  const cases::Case& scene_;
  GuidanceState state_;
};

// What holds of a modality whatever the case.
struct GuidanceKind {
  Needs needs;
  // What loading takes of a task's preparation; the rest is the plan. Measured on the built-in torso and the
  // contrast abdomen.
  double loading_share;
  const char* method;  // ScreenPainter::method, before anything is drawn
  bool probe_guides;   // else it is laid aside
  std::unique_ptr<Guidance> (*make)(const cases::Case& scene);
  // PathLimits::looks_from at this scene, which must outlive it; null: any place on the skin will do.
  assessment::LooksFrom (*looks_from)(const cases::Case& scene);
};
const GuidanceKind& guidance_kind(cases::Modality modality) noexcept;

// Of the scene's picture.
std::unique_ptr<Guidance> guidance_of(const cases::Case& scene);

}  // namespace seldinger::session
