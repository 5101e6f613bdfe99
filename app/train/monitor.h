// The screen that guides, while an attempt runs: a thread of its own draws what the newest moment shows, as often
// as the real machine would and no faster than it can, so that neither servo nor window ever waits for a picture.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/attempt_ticks.h"
#include "app/grey_picture.h"
#include "sim/base/snapshot.h"
#include "sim/case/case.h"
#include "sim/imaging/ultrasound/console.h"

namespace seldinger::app {

// What is on the screen, and how it came there.
struct ShownPicture {
  GreyPicture picture;
  double pixel_mm = 0.0, top_mm = 0.0;  // ultrasound: pixel (c, r) is at ((c − (width − 1)/2), top/pixel + r + ½)
  double t_s = 0.0;                     // the attempt's time that it shows
  double told_s = 0.0;                  // of the moment that it shows (Moment)
  std::uint64_t number = 0;             // rises with each new picture
  bool live = false;                    // neither frozen nor a held last image
  double rate_hz = 0.0;                 // pictures a second, lately
  double drawn_in_s = 0.0;              // what the last one took
  int cine_pictures = 0, cine_back = 0;
};

class Monitor {
 public:
  // `scene` (with its tissue under ultrasound) must outlive it. `seed` is the noise's.
  Monitor(const cases::Case& scene, std::uint64_t seed);
  ~Monitor();
  Monitor(const Monitor&) = delete;
  Monitor& operator=(const Monitor&) = delete;

  // By the servo after each tick: waits for nothing.
  void show(const Moment& moment) noexcept;

  // By the window. `change` is called on the monitor's thread, soon; ultrasound only.
  void set_console(std::function<void(imaging::Console&)> change);
  // The newest picture, if there is one since the last call; `shown`'s memory is used again.
  bool take(ShownPicture& shown);

  // How pictures are made: "scatterers, CPU", for the screen's corner.
  const std::string& method() const noexcept { return method_; }

 private:
  class Painter;
  void run();

  const cases::Case& scene_;
  std::uint64_t seed_;
  std::string method_;
  base::Snapshot<Moment> moments_, pulses_;
  std::uint32_t pulses_seen_ = 0;  // the servo's
  std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<std::function<void(imaging::Console&)>> changes_;
  ShownPicture newest_;
  bool fresh_ = false;
  bool stopping_ = false;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::app
