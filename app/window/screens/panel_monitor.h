// The screen that guides, with its console: what the monitor drew, its knobs and keys, calipers and the cine loop.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/replay/canvas.h"
#include "app/window/hands/calipers.h"
#include "app/window/hands/console_knobs.h"
#include "app/window/hands/person_attempt.h"
#include "app/window/surface/window.h"
#include "session/monitor/monitor.h"
#include "sim/gpu/screen_picture.h"

namespace seldinger::app {

class MonitorPanel {
 public:
  explicit MonitorPanel(gpu::Context& context)
      : picture_(context, gpu::ScreenPicture::Pixels::grey), coloured_(context, gpu::ScreenPicture::Pixels::rgba) {}

  // A new attempt, with a console of its own: knobs stand where that begins, calipers and picture are gone.
  void begin(const cases::Case& scene);

  // The picture with what is told below it, in what room there is; and the console's keys, also of one that is
  // folded. What they ask of the attempt goes into `told`; null: an attempt that is watched, whose knobs stand as
  // they did and turn nothing but the screen. `lamps`: whether tip and target are in the picture.
  void draw(session::Monitor& monitor, const Seen& seen, bool lamps, const Keys& keys, HandsTold* told);
  // The console's knobs, after the picture, and how high they are in a part so wide.
  void draw_console(session::Monitor& monitor, const Seen& seen, HandsTold* told);
  float console_height(float width, const HandsTold* told) const;

  // Between saying and showing a frame: a picture that has come since is in it, too.
  void take_late(session::Monitor& monitor);

  const session::ShownPicture& shown() const noexcept { return shown_; }
  const gpu::ScreenPicture& picture() const noexcept {
    return shown_.picture.colour.empty() ? picture_ : coloured_;
  }
  const ConsoleKnobs& knobs() const noexcept { return knobs_; }

  // The depth that calipers measured from the face down, once each time they are let go.
  std::optional<double> take_depth_mm() noexcept { return std::exchange(measured_mm_, std::nullopt); }
  // The guidance's picture, once, where somebody asked to keep it.
  std::optional<Canvas> take_kept();
  // Shown at the picture for a moment.
  void say(std::string note);

 private:
  void read_keys(session::Monitor& monitor, bool frozen, bool watched, const Keys& keys);
  void put_on_screen();  // what is shown now
  void draw_picture(const Seen& seen, float width, float height, bool turns);
  void move_colour_box(float left, float top, float zoom);
  void draw_guide(const devices::ProbeGuide& guide, float left, float top, float zoom);
  void draw_flash(const cases::State& state, float left, float top, float width, float height);
  void draw_lamps(const std::optional<cases::FrameTruth>& frame);
  void draw_status(const session::Monitor& monitor, const cases::State& state);
  void draw_marks(float left, float top, float zoom);
  void measure(float left, float top, float zoom);
  void draw_ultrasound(session::Monitor& monitor, bool frozen, bool turns);
  bool draw_beam_knobs(float wide);    // preset, depth, focus, frequency; true: another preset
  bool draw_screen_knobs(float wide);  // gain, range, grey map, flip, time gain; true: turned
  void draw_colour_knobs(float wide);  // on or off, and its scale
  void draw_slices(session::Monitor& monitor, bool frozen, bool turns);
  void read_fluoroscope(const Keys& keys, cases::FluoroscopeInputs& asked) const;
  void expose_automatically(bool automatic, cases::FluoroscopeInputs& asked) const;
  void draw_fluoroscope(session::Monitor& monitor, cases::FluoroscopeInputs& asked);
  cases::FluoroscopeInputs asked_of(const HandsTold* told) const;
  void draw_exposure(const cases::FluoroscopyState& machine);
  void draw_calipers_and_keep(bool calipers);
  void roll(session::Monitor& monitor, int notches, bool frozen, bool watched);  // the wheel over the picture
  void tell(session::Monitor& monitor) const;                                    // what acts on the screen
  void keep();

  gpu::ScreenPicture picture_, coloured_;  // grey alone; with flow in colour
  session::ShownPicture shown_;
  cases::Picture kind_;
  cases::Fluoroscope machine_;
  cases::FluoroscopyState machine_state_;
  ConsoleKnobs knobs_;
  int panel_ = 0;  // imaging::Panel
  Calipers calipers_;
  std::optional<double> measured_mm_;  // not yet taken
  bool measuring_ = false, frozen_ = false;
  int notches_ = 0;  // of the wheel, over the picture, in this frame
  double dose_from_s_ = 0.0, dose_from_mgy_ = 0.0, dose_mgy_min_ = 0.0;  // lately
  std::optional<Canvas> kept_;
  std::string fire_words_, colour_words_;
  std::string note_;
  double note_until_s_ = 0.0;
};

}  // namespace seldinger::app
