// The screen that guides, while an attempt runs: a thread of its own draws what the newest moment shows, as often
// as the real machine would and no faster than it can, so that the servo never waits for a picture, and the window
// no longer than it likes. A picture that is asked for when the window begins to draw is there when it has drawn;
// one that is made unasked would be old by then, or never seen.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "session/guidance/guidance.h"
#include "session/guidance/screen_painter.h"
#include "sim/base/snapshot.h"
#include "sim/case/case.h"
#include "sim/engine/tick.h"

namespace seldinger::session {

// Seconds of the machine's steady clock: by it lags from hand to picture are told, across threads.
double clock_s() noexcept;

class Monitor {
 public:
  // `scene` (with its tissue under ultrasound) must outlive it. `seed` is the noise's. `by`: by the GPU on a
  // context of the monitor's own, and by the CPU where there is none.
  Monitor(const cases::Case& scene, std::uint64_t seed, PicturesBy by = PicturesBy::cpu);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  // By the servo after each tick: waits for nothing.
  void show(const engine::Moment& moment) noexcept;

  // By the window. `change` is called on the monitor's thread, soon; ultrasound only.
  void set_console(std::function<void(imaging::Console&)> change);
  void set_window(const HuWindow& window);  // slices only
  void set_panel(imaging::Panel panel);     // fluoroscopy only
  // A picture of the newest moment, as soon as the machine's rate allows. Those that are asked for come at that
  // rate; unasked a few come, for the cine loop, and a fluoroscope's whenever it pulses.
  void want();
  // When the picture that was asked for, or is being made, can be expected, by clock_s; nothing: none is.
  std::optional<double> expected_s() const;
  bool fresh() const;  // there is one to take
  // The newest picture, if there is one since the last call; `shown`'s memory is used again.
  bool take(ShownPicture& shown);

  // How pictures are made: "scatterers, CPU", for the screen's corner. Ultrasound's may change (speckle_choice.h).
  std::string method() const;

 private:
  void run();

  std::unique_ptr<Guidance> guidance_;
  std::uint64_t seed_;
  PicturesBy by_;
  std::string method_;  // mutex_'s
  base::Snapshot<engine::Moment> moments_, pulses_;
  std::uint32_t pulses_seen_ = 0;  // the servo's
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<std::function<void(imaging::Console&)>> changes_;
  std::optional<HuWindow> window_;  // that is not drawn with yet
  std::optional<imaging::Panel> panel_;
  ShownPicture newest_;
  bool fresh_ = false;
  bool stopping_ = false, wanted_ = false;
  std::optional<double> begun_s_;       // that is being made, by clock_s
  double due_s_ = 0.0, usual_s_ = 0.0;  // when the next may begin; what one takes, lately
  std::thread thread_;                  // last: it uses the rest
};

}  // namespace seldinger::session
