#include "session/guidance/fluoroscopy_guidance.h"

#include "session/guidance/fluoroscopy.h"
#include "session/guidance/screen_painter.h"

namespace seldinger::session {
namespace {

constexpr const char* kFluoroscopyMethod = "exact projection, CPU";
// Pulses come 1/15 s apart at the least, and each must have been looked at well before the next: the servo takes
// its report in.
constexpr double kPulsesLookedForHz = 500.0;

class FluoroscopyPainter : public ScreenPainter {
 public:
  FluoroscopyPainter(const cases::Case& scene, std::uint64_t seed) : room_(scene), seed_(seed) {}

  void draw(const engine::Moment& moment, ShownPicture& shown) override {
    shown.picture = room_.picture(moment.state, seed_, moment.displacement);
    shown.t_s = moment.state.t_s;
    ++shown.number;
  }

  std::string method() const override { return kFluoroscopyMethod; }

  void set_panel(imaging::Panel panel) override { room_.set_panel(panel); }

 private:
  FluoroscopySight room_;
  std::uint64_t seed_;
};

class FluoroscopyGuidance : public Guidance {
 public:
  using Guidance::Guidance;

  bool pulsed() const noexcept override { return true; }
  double rate_hz(const cases::ConsoleSetting&) const noexcept override { return kPulsesLookedForHz; }
  bool live(const cases::State& state) const noexcept override { return state.fluoroscopy.live; }
  bool due(const cases::State& state) override { return state.fluoroscopy.frame_due; }

  GreyPicture picture(const cases::State& state, const tissue::Displacement& displacement,
                      const PictureNoise& noise) override {
    return room().picture(state, noise.seed, displacement);
  }

  std::unique_ptr<ScreenPainter> painter(std::uint64_t seed, PicturesBy) const override {
    return std::make_unique<FluoroscopyPainter>(scene_, seed);
  }

 protected:
  void look(const cases::State& state, const tissue::Displacement& displacement) override {
    const FluoroscopySight::Exposed exposed = room().expose(state, displacement);
    state_.truth = exposed.truth;
    state_.fix = exposed.fix;
    state_.report = exposed.report;
  }

 private:
  // Made with the first picture: it takes as long as a picture, and who only asks for painters needs none.
  FluoroscopySight& room() {
    if (!room_) room_.emplace(scene_);
    return *room_;
  }

  std::optional<FluoroscopySight> room_;
};

std::unique_ptr<Guidance> make_fluoroscopy_guidance(const cases::Case& scene) {
  return std::make_unique<FluoroscopyGuidance>(scene);
}

}  // namespace

const GuidanceKind kFluoroscopyGuidance{.needs = Needs::touch,
                                        .loading_share = 0.84,
                                        .method = kFluoroscopyMethod,
                                        .probe_guides = false,
                                        .make = &make_fluoroscopy_guidance,
                                        .looks_from = nullptr};

}  // namespace seldinger::session
