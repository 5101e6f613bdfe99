// Paints live ultrasound: what the probe receives goes through the machine's console and its cine loop. By the GPU
// where it is asked for and there is one.
#pragma once

#include <optional>

#include "session/guidance/screen_painter.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/case/case.h"
#include "sim/gpu/context.h"
#include "sim/imaging/ultrasound/colour_screen.h"
#include "sim/imaging/ultrasound/console.h"

namespace seldinger::session {

class UltrasoundPainter : public ScreenPainter {
 public:
  static constexpr const char* kFirstMethod = "scatterers, CPU";

  // `scene`, with its tissue, must outlive it. `seed` is the noise's.
  UltrasoundPainter(const cases::Case& scene, std::uint64_t seed, PicturesBy by);

  void draw(const engine::Moment& moment, ShownPicture& shown) override;
  std::string method() const override;
  void set_speckle(imaging::UltrasoundMethod method) override;
  imaging::Console* console() override { return &console_; }
  void develop(ShownPicture& shown) override;

 private:
  void receive(const engine::Moment& moment);
  void try_gpu();
  void leave_gpu();

  const cases::Case& scene_;
  std::uint64_t seed_;
  std::optional<gpu::Context> context_;
  UltrasoundSight sight_;
  imaging::UltrasoundMethod method_ = imaging::UltrasoundMethod::scatterers;
  imaging::Console console_;
  std::optional<imaging::ScanConverter> converter_;
  std::optional<imaging::ColourScreen> colour_screen_;  // of converter_
  double converted_depth_mm_ = 0.0;
  imaging::PolarPicture polar_;
  std::uint64_t pictures_ = 0;
};

}  // namespace seldinger::session
