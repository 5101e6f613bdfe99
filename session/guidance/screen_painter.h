// What a monitor shows, and what paints it: the live pictures of one modality, with what only a person at the
// screen sets. Used by one thread, the one that made it.
#pragma once

#include <cstdint>
#include <string>

#include "session/guidance/grey_picture.h"
#include "session/guidance/slice_picture.h"
#include "sim/case/console.h"
#include "sim/engine/tick.h"
#include "sim/imaging/ultrasound/console.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"
#include "sim/imaging/xray/panel.h"

namespace seldinger::session {

// What makes ultrasound's pictures. Slices and fluoroscopy are the CPU's.
enum class PicturesBy { cpu, gpu };

// What is on the screen, and how it came there.
struct ShownPicture {
  GreyPicture picture;
  // Pixel (c, r) is at ((c − (width − 1)/2), top/pixel + r + ½); pixel 0: fluoroscopy, which has no one scale.
  double pixel_mm = 0.0, top_mm = 0.0;
  cases::ConsoleSetting console{};  // as it stood then, in what the probe can do; slices: in what is offered
  double t_s = 0.0;                 // the attempt's time that it shows
  double told_s = 0.0;              // of the moment that it shows (Moment)
  std::uint64_t number = 0;         // rises with each new picture
  bool live = false;                // neither frozen nor a held last image
  double rate_hz = 0.0;             // pictures a second, lately
  double drawn_in_s = 0.0;          // what the last one took
  int cine_pictures = 0, cine_back = 0;
};

class ScreenPainter {
 public:
  virtual ~ScreenPainter() = default;

  // Of a new moment; `shown.live` tells whether pictures follow what happens.
  virtual void draw(const engine::Moment& moment, ShownPicture& shown) = 0;

  // How pictures are made: "scatterers, CPU".
  virtual std::string method() const = 0;

  // Ultrasound's alone: how speckle is made, the machine's console (nullptr: there is none), and what that holds,
  // drawn as it is set now.
  virtual void set_speckle(imaging::UltrasoundMethod) {}
  virtual imaging::Console* console() { return nullptr; }
  virtual void develop(ShownPicture&) {}

  // Slices' alone: the moment that was drawn last, in this window.
  virtual void set_window(const HuWindow&, ShownPicture&) {}

  // A fluoroscope's alone: from the next pulse on.
  virtual void set_panel(imaging::Panel) {}
};

}  // namespace seldinger::session
