#include "session/guidance/slice_guidance.h"

#include <algorithm>

#include "session/guidance/frame_truth.h"
#include "session/guidance/probe_guidance.h"
#include "session/guidance/screen_painter.h"
#include "session/guidance/slice_picture.h"
#include "sim/case/record/recorded_tick.h"
#include "sim/imaging/mpr/visibility.h"

namespace seldinger::session {
namespace {

constexpr const char* kSliceMethod = "trilinear, CPU";

class SlicePainter : public ScreenPainter {
 public:
  explicit SlicePainter(const cases::Case& scene) : scene_(scene) {}

  void draw(const engine::Moment& moment, ShownPicture& shown) override {
    if (!shown.live) return;
    moment_ = moment;
    paint(shown);
  }

  std::string method() const override { return kSliceMethod; }

  void set_window(const HuWindow& window, ShownPicture& shown) override {
    window_ = window;
    if (shown.number > 0) paint(shown);
  }

 private:
  void paint(ShownPicture& shown) {
    const cases::State& state = moment_.state;
    const cases::ConsoleSetting& console = state.probe.console;
    const imaging::NeedlePose needle =
        imaging::needle_pose(scene_.instrument, state.needle.tip_lps_mm, state.needle.direction);
    shown.picture =
        slice_under_probe(scene_, cases::pose_of(state), console, needle, moment_.displacement, window_);
    shown.pixel_mm = kSlicePixelMm;
    shown.console = {scene_.picture.depth_mm, 0.0, 0.0, std::clamp(console.slice_mm, -kMostSliceMm, kMostSliceMm)};
    shown.t_s = state.t_s;
    ++shown.number;
  }

  const cases::Case& scene_;
  engine::Moment moment_;  // of which the slice is
  HuWindow window_ = kHuWindows[0];
};

class SliceGuidance : public ProbeGuidance {
 public:
  using ProbeGuidance::ProbeGuidance;

  double rate_hz(const cases::ConsoleSetting&) const noexcept override { return scene_.picture.rate_hz; }

  GreyPicture picture(const cases::State& state, const tissue::Displacement& displacement,
                      const PictureNoise&) override {
    return slice_under_probe(scene_, cases::pose_of(state), state.probe.console, needle_in(state), displacement);
  }

  std::unique_ptr<ScreenPainter> painter(std::uint64_t, PicturesBy) const override {
    return std::make_unique<SlicePainter>(scene_);
  }

 protected:
  cases::FrameTruth shown(const cases::State& state, const tissue::Displacement& displacement) const override {
    auto target = target_of(scene_.lesions);
    if (target) target = tissue::displaced(displacement, *target);
    const imaging::MprView view = slice_view(scene_.picture, cases::pose_of(state), state.probe.console);
    return frame_truth(state.t_s, imaging::mpr_visible(view, needle_in(state), target));
  }
};

std::unique_ptr<Guidance> make_slice_guidance(const cases::Case& scene) {
  return std::make_unique<SliceGuidance>(scene);
}

}  // namespace

const GuidanceKind kSliceGuidance{.needs = Needs::touch,
                                  .loading_share = 0.65,
                                  .method = kSliceMethod,
                                  .probe_guides = true,
                                  .make = &make_slice_guidance,
                                  .looks_from = nullptr};

}  // namespace seldinger::session
