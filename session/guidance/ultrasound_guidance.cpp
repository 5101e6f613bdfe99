#include "session/guidance/ultrasound_guidance.h"

#include "session/guidance/frame_truth.h"
#include "session/guidance/probe_guidance.h"
#include "session/guidance/ultrasound_painter.h"
#include "session/guidance/ultrasound_sight.h"

namespace seldinger::session {
namespace {

class UltrasoundGuidance : public ProbeGuidance {
 public:
  explicit UltrasoundGuidance(const cases::Case& scene) : ProbeGuidance(scene), sight_(scene) {}

  double rate_hz(const cases::ConsoleSetting& console) const noexcept override {
    return picture_rate_hz(scene_.picture, console);
  }

  GreyPicture picture(const cases::State& state, const tissue::Displacement& displacement,
                      const PictureNoise& noise) override {
    return sight_.picture(probe_in(state), state.probe.console, needle_in(state), noise.seed, noise.number,
                          displacement, state.t_s);
  }

  std::unique_ptr<ScreenPainter> painter(std::uint64_t seed, PicturesBy by) const override {
    return std::make_unique<UltrasoundPainter>(scene_, seed, by);
  }

 protected:
  cases::FrameTruth shown(const cases::State& state, const tissue::Displacement& displacement) const override {
    return frame_truth(state.t_s, sight_.see(probe_in(state), state.probe.console, needle_in(state), displacement));
  }

 private:
  UltrasoundSight sight_;
};

std::unique_ptr<Guidance> make_ultrasound_guidance(const cases::Case& scene) {
  return std::make_unique<UltrasoundGuidance>(scene);
}

assessment::LooksFrom looks_from(const cases::Case& scene) {
  return [&scene](const assessment::PuncturePlan& plan, const assessment::WorthTaking& worth) {
    return UltrasoundSight(scene).looks_from(plan, worth, scene.lesions.front());
  };
}

}  // namespace

const GuidanceKind kUltrasoundGuidance{.needs = Needs::ultrasound,
                                       .loading_share = 0.3,
                                       .method = UltrasoundPainter::kFirstMethod,
                                       .probe_guides = true,
                                       .make = &make_ultrasound_guidance,
                                       .looks_from = &looks_from};

}  // namespace seldinger::session
