#include "app/train/monitor.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "app/fluoroscopy.h"
#include "app/train/speckle_choice.h"
#include "app/ultrasound_sight.h"
#include "sim/base/failure.h"
#include "sim/imaging/ultrasound/view.h"

namespace seldinger::app {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

imaging::NeedlePose needle_of(const cases::Case& scene, const cases::State& state) {
  return imaging::needle_pose(scene.instrument, state.needle.tip_lps_mm, state.needle.direction);
}

// As the picture of the case is set.
imaging::ConsolePreset preset_of(const cases::Picture& picture) {
  const imaging::Probe* probe = imaging::probe_named(picture.probe);
  return {"case", probe != nullptr ? *probe : imaging::kC52v, picture.depth_mm, 0.0, 60.0};
}

constexpr double kRateOver = 0.9;   // of the rate that is told, what was before counts so much
constexpr double kUsualOver = 0.7;  // likewise of what a picture takes
constexpr std::chrono::milliseconds kUnasked(100);

}  // namespace

// Draws on the monitor's thread.
class Monitor::Painter {
 public:
  Painter(const cases::Case& scene, std::uint64_t seed, PicturesBy by) : scene_(scene), seed_(seed) {
    if (scene.picture.modality == cases::Modality::ultrasound) {
      sight_.emplace(scene);
      if (by == PicturesBy::gpu) try_gpu();
      console_.emplace(preset_of(scene.picture));
    }
    if (scene.picture.modality == cases::Modality::xray) room_.emplace(scene);
  }

  bool ultrasound() const noexcept { return sight_.has_value(); }
  std::string set_method(imaging::UltrasoundMethod method) {
    sight_->set_method(method);
    const std::string on = !context_ ? "CPU" : context_->software() ? "GL in software" : "GPU";
    return (method == imaging::UltrasoundMethod::lattice ? "lattice, " : "scatterers, ") + on;
  }

  imaging::Console* console() { return console_ ? &*console_ : nullptr; }

  // Of a new moment.
  void draw(const engine::Moment& moment, ShownPicture& shown) {
    const cases::State& state = moment.state;
    shown.told_s = moment.told_s;
    shown.live = room_ ? state.fluoroscopy.live : !state.probe.frozen;
    if (room_) {
      shown.picture = room_->picture(state, seed_, moment.displacement);
      shown.t_s = state.t_s;
      ++shown.number;
      return;
    }
    const cases::ToolPose probe{state.probe.origin_lps_mm, state.probe.axial, state.probe.lateral};
    const imaging::NeedlePose needle = needle_of(scene_, state);
    if (!sight_) {
      if (!shown.live) return;
      slice_ = moment;
      draw_slice(shown);
      return;
    }
    if (console_->frozen() == shown.live) console_->set_frozen(!shown.live);
    if (console_->frozen() && shown.number > 0) return;  // it stands, until the console is changed
    if (!console_->frozen()) {
      const auto make = [&] {
        return sight_->polar(probe, state.probe.console, needle, seed_, pictures_, polar_, moment.displacement);
      };
      ++pictures_;
      imaging::UltrasoundView view;
      try {
        view = make();
      } catch (const base::Failure&) {
        if (!context_) throw;
        leave_gpu();
        view = make();
      }
      console_->show(state.t_s, pictures_, view, polar_);
    }
    develop(shown);
  }

  // Of the moment that was drawn last.
  void set_window(const HuWindow& window, ShownPicture& shown) {
    window_ = window;
    if (shown.number > 0) draw_slice(shown);
  }

  // Of what the console holds, as it is set now.
  void develop(ShownPicture& shown) {
    const auto cine = console_->shown();
    if (!cine) return;
    if (!converter_ || converted_depth_mm_ != cine->view.depth_mm) {
      converter_.emplace(cine->view, imaging::DisplaySize{});
      converted_depth_mm_ = cine->view.depth_mm;
    }
    converter_->grey(cine->view, console_->knobs(), cine->picture, shown.picture.grey);
    shown.picture.width_px = converter_->width_px();
    shown.picture.height_px = std::min(
        converter_->height_px(),  // without the empty rows below a wide field
        static_cast<int>(std::ceil((cine->view.depth_mm - converter_->top_mm()) / converter_->pixel_mm())));
    shown.picture.grey.resize(static_cast<std::size_t>(shown.picture.height_px) *
                              static_cast<std::size_t>(shown.picture.width_px));
    shown.pixel_mm = converter_->pixel_mm();
    shown.top_mm = converter_->top_mm();
    shown.console = {cine->view.depth_mm, cine->view.focus_mm, imaging::working_mhz(cine->view)};
    shown.t_s = cine->t_s;
    shown.cine_back = console_->scrolled();
    ++shown.number;
  }

 private:
  void try_gpu() {
    try {
      context_.emplace();
      sight_->draw_on(*context_);
    } catch (const base::Failure&) {  // no GL without a window, or too little memory: the CPU's are the same
      leave_gpu();
    }
  }
  void leave_gpu() {
    sight_->draw_on_cpu();
    context_.reset();
  }

  void draw_slice(ShownPicture& shown) {
    const cases::State& state = slice_.state;
    const cases::ConsoleSetting& console = state.probe.console;
    shown.picture =
        slice_under_probe(scene_, pose_of(state), console, needle_of(scene_, state), slice_.displacement, window_);
    shown.pixel_mm = kSlicePixelMm;
    shown.console = {scene_.picture.depth_mm, 0.0, 0.0, std::clamp(console.slice_mm, -kMostSliceMm, kMostSliceMm)};
    shown.t_s = state.t_s;
    ++shown.number;
  }

  const cases::Case& scene_;
  std::uint64_t seed_;
  std::optional<gpu::Context> context_;
  std::optional<UltrasoundSight> sight_;
  std::optional<imaging::Console> console_;
  std::optional<imaging::ScanConverter> converter_;
  double converted_depth_mm_ = 0.0;
  imaging::PolarPicture polar_;
  std::optional<FluoroscopyRoom> room_;
  engine::Moment slice_;  // of which the slice is
  HuWindow window_ = kHuWindows[0];
  std::uint64_t pictures_ = 0;
};

double clock_s() noexcept {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

Monitor::Monitor(const cases::Case& scene, std::uint64_t seed, PicturesBy by)
    : scene_(scene), seed_(seed), by_(by) {
  switch (scene.picture.modality) {
    case cases::Modality::ultrasound:
      method_ = "scatterers, CPU";
      break;
    case cases::Modality::xray:
      method_ = "exact projection, CPU";
      break;
    case cases::Modality::mpr:
      method_ = "trilinear, CPU";
      break;
  }
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

void Monitor::want() {
  if (scene_.picture.modality == cases::Modality::xray) return;
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
  Painter painter(scene_, seed_, by_);
  SpeckleChoice speckle;
  const bool xray = scene_.picture.modality == cases::Modality::xray;
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
      if (!xray)
        woken_.wait_for(lock, kUnasked, [&] { return stopping_ || wanted_ || !changes_.empty() || window_; });
      if (stopping_) return;
      changes.swap(changes_);
      wanted_ = false;
      if (painter.ultrasound()) method_ = painter.set_method(speckle.method());
      if (!xray) begun_s_ = clock_s();
      window.swap(window_);
    }
    const double between_s = xray ? 0.002 : 1.0 / picture_rate_hz(scene_.picture, stands);
    due = std::max(due + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(between_s)),
                   Clock::now());
    const std::uint64_t before = work.number;
    const auto begun = Clock::now();
    const auto newest = moments_.take();
    const auto pulse = xray ? pulses_.take() : std::nullopt;
    if (pulse) {
      const std::lock_guard lock(mutex_);
      begun_s_ = clock_s();
    }
    if (newest) stands = newest->state.probe.console;
    if (window && scene_.picture.modality == cases::Modality::mpr) painter.set_window(*window, work);
    window.reset();
    if (auto* console = painter.console())
      for (const auto& change : changes) change(*console);
    if (xray ? pulse.has_value() : newest.has_value()) painter.draw(xray ? *pulse : *newest, work);
    if (!changes.empty() && painter.console() != nullptr && painter.console()->frozen()) painter.develop(work);
    if (xray && newest) work.live = newest->state.fluoroscopy.live;
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
    if (auto* console = painter.console()) work.cine_pictures = console->cine_pictures();
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

}  // namespace seldinger::app
