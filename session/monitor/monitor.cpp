#include "session/monitor/monitor.h"

#include <algorithm>
#include <chrono>

#include "session/monitor/speckle_choice.h"

namespace seldinger::session {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

constexpr double kRateOver = 0.9;   // of the rate that is told, what was before counts so much
constexpr double kUsualOver = 0.7;  // likewise of what a picture takes
constexpr std::chrono::milliseconds kUnasked(100);

}  // namespace

double clock_s() noexcept {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

Monitor::Monitor(const cases::Case& scene, std::uint64_t seed, PicturesBy by)
    : guidance_(guidance_of(scene)), seed_(seed), by_(by), method_(guidance_kind(scene.picture.modality).method) {
  thread_ = std::thread([this] { run(); });
}

Monitor::~Monitor() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

std::string Monitor::method() const {
  const std::lock_guard lock(mutex_);
  return method_;
}

void Monitor::show(const engine::Moment& moment) noexcept {
  moments_.put(moment);
  if (moment.state.fluoroscopy.frames == pulses_seen_) return;
  pulses_seen_ = moment.state.fluoroscopy.frames;
  pulses_.put(moment);
}

void Monitor::set_console(std::function<void(imaging::Console&)> change) {
  {
    const std::lock_guard lock(mutex_);
    changes_.push_back(std::move(change));
  }
  woken_.notify_all();
}

void Monitor::set_window(const HuWindow& window) {
  {
    const std::lock_guard lock(mutex_);
    window_ = window;
  }
  woken_.notify_all();
}

void Monitor::set_panel(imaging::Panel panel) {
  const std::lock_guard lock(mutex_);  // the next pulse wakes
  panel_ = panel;
}

void Monitor::want() {
  if (guidance_->pulsed()) return;
  {
    const std::lock_guard lock(mutex_);
    wanted_ = true;
  }
  woken_.notify_all();
}

std::optional<double> Monitor::expected_s() const {
  const std::lock_guard lock(mutex_);
  if (begun_s_) return *begun_s_ + usual_s_;
  if (wanted_) return std::max(due_s_, clock_s()) + usual_s_;
  return std::nullopt;
}

bool Monitor::fresh() const {
  const std::lock_guard lock(mutex_);
  return fresh_;
}

bool Monitor::take(ShownPicture& shown) {
  const std::lock_guard lock(mutex_);
  if (!fresh_) return false;
  std::swap(shown, newest_);
  fresh_ = false;
  return true;
}

void Monitor::run() {
  const std::unique_ptr<ScreenPainter> painter = guidance_->painter(seed_, by_);
  SpeckleChoice speckle;
  const bool pulsed = guidance_->pulsed();
  cases::ConsoleSetting stands;
  ShownPicture work;
  Clock::time_point due = Clock::now(), last_picture = due;
  double rate_hz = 0.0;
  bool live = false;
  std::vector<std::function<void(imaging::Console&)>> changes;
  std::optional<HuWindow> window;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      woken_.wait_until(lock, due, [&] { return stopping_; });
      if (!pulsed)
        woken_.wait_for(lock, kUnasked, [&] { return stopping_ || wanted_ || !changes_.empty() || window_; });
      if (stopping_) return;
      changes.swap(changes_);
      wanted_ = false;
      painter->set_speckle(speckle.method());
      method_ = painter->method();
      if (!pulsed) begun_s_ = clock_s();
      window.swap(window_);
      if (panel_) painter->set_panel(*panel_);
      panel_.reset();
    }
    const double between_s = 1.0 / guidance_->rate_hz(stands);
    due = std::max(due + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(between_s)),
                   Clock::now());
    const std::uint64_t before = work.number;
    const auto begun = Clock::now();
    const auto newest = moments_.take();
    const auto pulse = pulsed ? pulses_.take() : std::nullopt;
    if (pulse) {
      const std::lock_guard lock(mutex_);
      begun_s_ = clock_s();
    }
    if (newest) stands = newest->state.probe.console;
    if (window) painter->set_window(*window, work);
    window.reset();
    if (auto* console = painter->console())
      for (const auto& change : changes) change(*console);
    if (const auto& moment = pulsed ? pulse : newest) {
      work.told_s = moment->told_s;
      work.live = guidance_->live(moment->state);
      painter->draw(*moment, work);
    }
    if (!changes.empty() && painter->console() != nullptr && painter->console()->frozen()) painter->develop(work);
    if (pulsed && newest) work.live = guidance_->live(newest->state);
    changes.clear();
    const bool changed = work.number != before || work.live != live;
    live = work.live;
    if (work.number != before) {
      work.drawn_in_s = seconds_since(begun);
      const double now_hz = 1.0 / std::max(1e-3, seconds_since(last_picture));
      rate_hz = rate_hz > 0.0 ? kRateOver * rate_hz + (1.0 - kRateOver) * now_hz : now_hz;
      last_picture = Clock::now();
      if (work.live) speckle.made(clock_s(), work.drawn_in_s);
      work.rate_hz = rate_hz;
    }
    if (auto* console = painter->console()) work.cine_pictures = console->cine_pictures();
    const std::lock_guard lock(mutex_);
    begun_s_.reset();
    due_s_ = std::chrono::duration<double>(due.time_since_epoch()).count();
    if (work.number != before)
      usual_s_ = usual_s_ > 0.0 ? kUsualOver * usual_s_ + (1.0 - kUsualOver) * work.drawn_in_s : work.drawn_in_s;
    if (!changed) continue;
    newest_ = work;
    fresh_ = true;
  }
}

}  // namespace seldinger::session
