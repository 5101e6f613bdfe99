// The screen that guides, with its console: what the monitor drew, its knobs, calipers and the cine loop.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "app/train/monitor.h"
#include "sim/gpu/screen_picture.h"

namespace seldinger::app {

class MonitorPanel {
 public:
  explicit MonitorPanel(gpu::Context& context) : picture_(context, gpu::ScreenPicture::Pixels::grey) {}

  // A new attempt, with a console of its own: knobs stand where that begins, calipers and picture are gone.
  void begin(const cases::Case& scene);

  // In what room there is. `fluoroscope` is what the machine's console asks for; other cases do not touch it.
  void draw(Monitor& monitor, const cases::State& state, bool frozen, cases::FluoroscopeInputs& fluoroscope);

  // Between saying and showing a frame: a picture that has come since is in it, too.
  void take_late(Monitor& monitor);

  const ShownPicture& shown() const noexcept { return shown_; }
  const gpu::ScreenPicture& picture() const noexcept { return picture_; }

 private:
  void draw_picture(const Monitor& monitor, float width, float height);
  void draw_ultrasound(Monitor& monitor, bool frozen);
  void draw_fluoroscope(const cases::State& state, cases::FluoroscopeInputs& fluoroscope);
  void measure(const std::array<float, 2>& at_px);

  gpu::ScreenPicture picture_;
  ShownPicture shown_;
  cases::Picture kind_;
  imaging::UltrasoundKnobs knobs_;
  std::vector<std::array<float, 2>> calipers_px_;  // of the picture; pairs
  bool measuring_ = false;
};

}  // namespace seldinger::app
