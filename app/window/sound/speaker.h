// The door of OpenAL: plays the room's sounds, on a thread of its own, so that neither a slow sound system nor none
// ever keeps the window waiting. Where there is no device it is silent, and says so. One at a time: what OpenAL
// calls its current context is the program's.
#pragma once

#include <atomic>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "app/window/sound/sounds.h"

namespace seldinger::app {

class Speaker {
 public:
  enum class Output {
    device,  // the system's; asked for when the first sound may be heard
    memory,  // render() makes what would be heard: for tests
  };
  enum class State { unasked, open, none };  // none: there is no device
  struct Settings {
    Output output = Output::device;
    bool muted = false;
    double volume = 0.7;  // 0 to 1
  };

  explicit Speaker(const Settings& settings);
  ~Speaker();
  Speaker(const Speaker&) = delete;
  Speaker& operator=(const Speaker&) = delete;

  // All by the window's thread; none waits. While it is muted nothing begins, and what sounds is not heard.
  void play(std::span<const Sounding> sounds);
  void set_muted(bool muted);
  bool muted() const noexcept { return muted_; }
  void set_volume(double share);  // brought into 0 to 1
  double volume() const noexcept { return volume_; }
  State state() const noexcept { return state_; }
  // What was to be played since the last call, also where nothing is heard.
  std::vector<Sound> take_played() { return std::exchange(played_, {}); }

  // `memory` only (CHECKed): the next so many samples at kSoundHz, one channel.
  std::vector<float> render(int samples);

 private:
  class Voices;
  void run();
  void serve(Voices& voices);

  std::atomic<bool> muted_;
  std::atomic<double> volume_;
  std::atomic<State> state_{State::unasked};
  std::mutex mutex_;
  std::condition_variable woken_;
  std::vector<Sounding> asked_;
  bool changed_ = true, stopping_ = false;
  std::vector<Sound> played_;  // the window's
  std::unique_ptr<Voices> in_memory_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::app
