#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <thread>
#include <utility>

#include "app/cli/file.h"
#include "app/replay/png.h"
#include "app/window/desk.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

constexpr double kTellEveryS = 0.25;
constexpr int kFramesOfAKey = 2;        // in the second after its own a press has moved the focus
constexpr double kHiddenS = 0.1;        // from frame to frame of a window that nobody sees
constexpr double kHandsEveryS = 0.004;  // half of what lies between two words of a usual mouse
constexpr double kNoticeS = 4.0, kVolumeStep = 0.1;
// A window that is drawn in software leaves the processor to servo and pictures.
constexpr double kMostFramesS = 60.0, kMostFramesInSoftwareS = 25.0;
// And where nothing moves by itself it is drawn so often only while somebody does something, and a little after.
constexpr double kRestS = 0.125, kStirredS = 0.4;

// Looking at it takes every arena's lock in turn: not while an attempt runs.
double heap_mib() {
  const struct mallinfo2 held = mallinfo2();
  return static_cast<double>(held.uordblks + held.hblkhd) / (1024.0 * 1024.0);
}

std::string name_of(Trainer& trainer) {
  PersonAttempt* attempt = trainer.attempt();
  switch (trainer.screen()) {
    case TrainerScreen::log_in:
      return "log_in";
    case TrainerScreen::choose:
      return "choose";
    case TrainerScreen::briefing:
      return attempt != nullptr && attempt->phase() == PersonAttempt::Phase::ready ? "ready" : "briefing";
    case TrainerScreen::attempt:
      return attempt != nullptr && attempt->phase() == PersonAttempt::Phase::running ? "attempt" : "storing";
    case TrainerScreen::debrief:
      return "debrief";
    case TrainerScreen::answer:
      return "answer";
    case TrainerScreen::watch:
      return "watch";
    case TrainerScreen::editor:
      return "editor";
    case TrainerScreen::devices:
      return "devices";
  }
  return "";
}

// For the window's title.
std::string words_of(const Trainer& trainer) {
  switch (trainer.screen()) {
    case TrainerScreen::log_in:
      return "Log in";
    case TrainerScreen::choose:
      return "Cases";
    case TrainerScreen::briefing:
      return trainer.chosen().title + " – briefing";
    case TrainerScreen::attempt:
      return trainer.chosen().title;
    case TrainerScreen::debrief:
      return trainer.chosen().title + " – debrief";
    case TrainerScreen::answer:
      return "Questionnaire";
    case TrainerScreen::watch:
      return trainer.chosen().title + " – replay";
    case TrainerScreen::editor:
      return "Case editor";
    case TrainerScreen::devices:
      return "Hand devices";
  }
  return "";
}

// For a screen reader.
std::string words_of(const std::string& screen) {
  if (screen == "choose") return "the list of cases";
  if (screen == "attempt") return "the room";
  if (screen == "ready" || screen == "briefing") return "the briefing";
  if (screen == "storing") return "the attempt is being stored";
  if (screen == "editor") return "the case editor";
  if (screen == "devices") return "the hands";
  if (screen == "answer") return "a questionnaire";
  if (screen == "watch") return "a replay";
  return screen == "log_in" ? "log in" : screen;
}

}  // namespace

Desk::Desk(Window& window, Trainer& trainer, DeskOptions options, std::filesystem::path pictures, Trace& trace,
           ScreenWords& words)
    : window_(window),
      trainer_(trainer),
      speaker_(options.sound),
      choose_(window.context()),
      briefing_(window.context()),
      attempt_(window.context(), options, speaker_),
      watch_(window.context(), speaker_),
      editor_(window.context()),
      pictures_(std::move(pictures)),
      trace_(trace),
      words_(words),
      opened_s_(session::clock_s()),
      told_s_(opened_s_),
      between_s_(1.0 / (window.context().software() ? kMostFramesInSoftwareS : kMostFramesS)) {
  look_for_space_mouse();
  note_items(trace_.wanted() || words_.wanted());
}

void Desk::look_for_space_mouse() {
  if (space_mouse_) return;
  if (auto found = devices::SpaceMouse::open()) space_mouse_.emplace(std::move(*found));
}

OtherHands Desk::other_hands() {
  OtherHands other;
  other.gamepad = window_.gamepad();
  if (space_mouse_ && !space_mouse_->connected()) space_mouse_.reset();
  if (space_mouse_) other.space_mouse = space_mouse_->poll();
  return other;
}

void Desk::draw_screen() {
  const Keys& keys = window_.keys();
  switch (trainer_.screen()) {
    case TrainerScreen::log_in:
      editor_.end();
      log_in_.draw(trainer_);
      break;
    case TrainerScreen::choose:
      editor_.end();
      choose_.draw(trainer_, keys, window_.take_dropped());
      break;
    case TrainerScreen::briefing:
      watch_.end();
      if (briefing_.draw(trainer_, keys) || trainer_.restarting()) attempt_.begin(trainer_);
      if (briefing_.take_resume()) attempt_.resume(trainer_);
      break;
    case TrainerScreen::attempt:
      attempt_.draw(trainer_, keys, window_.pointer(), other_hands());
      break;
    case TrainerScreen::debrief:
      attempt_.end();
      watch_.end();
      debrief_.draw(trainer_, keys, &attempt_.picture_at_fire());
      break;
    case TrainerScreen::answer:
      answering_.draw(trainer_, keys);
      break;
    case TrainerScreen::watch:
      watch_.draw(trainer_, keys);
      break;
    case TrainerScreen::editor:
      attempt_.end();
      editor_.draw(trainer_, keys);
      break;
    case TrainerScreen::devices:
      devices_.draw(trainer_, keys, other_hands());
      return;  // F10 was to leave it
  }
  if (keys.pressed(kF1 + 9)) trainer_.show_devices();
}

bool Desk::settles() {
  const std::optional<int> heard = window_.keys_heard();
  since_key_ = heard == keys_ ? since_key_ + 1 : 0;
  if (heard) keys_ = *heard;
  if (since_key_ != kFramesOfAKey) return false;
  return std::exchange(keys_shown_, keys_) != keys_;
}

void Desk::tell(const std::string& screen) {
  const double now_s = session::clock_s(), passed_s = now_s - told_s_;
  ++frames_;
  const bool hands = screen == "attempt" || screen == "watch", settled = settles();
  const bool tells = screen != told_ || (settled && !hands) || (screen == "attempt" && attempt_.first_picture());
  if (passed_s < kTellEveryS && !tells) return;
  TraceLine line;
  line.t_s = now_s - opened_s_;
  line.screen = screen;
  line.frames = frames_;
  line.frames_s = (frames_ - frames_told_) / std::max(1e-3, passed_s);
  if (screen == "attempt") {
    attempt_.tell(line);
    line.pictures_s /= std::max(1e-3, passed_s);
  } else {
    line.heap_mib = heap_mib();
  }
  if (screen == "watch") watch_.tell(line);
  for (const Sound sound : speaker_.take_played()) line.sounds.emplace_back(info_of(sound).name);
  if (screen == "editor" && trainer_.editor() != nullptr) EditorPanel::tell(*trainer_.editor(), line);
  if (screen == "devices" && trainer_.device_page() != nullptr) devices_.tell(*trainer_.device_page(), line);
  line.keys = keys_shown_;
  line.focus = focus();
  line.width_px = window_.width_px();
  line.height_px = window_.height_px();
  line.items = noted_items();
  trace_.write(line);
  told_s_ = now_s;
  frames_told_ = frames_;
}

std::string Desk::keep(const std::string& name, const std::vector<unsigned char>& rgb, int width_px,
                       int height_px) {
  const std::vector<std::byte> png = png_from_rgb(rgb, width_px, height_px);
  std::string file;
  int number = 0;
  do {
    file = name + "-" + std::to_string(++number) + ".png";
  } while (std::filesystem::exists(pictures_ / file));
  try {
    write_file(pictures_ / file, {reinterpret_cast<const char*>(png.data()), png.size()});
  } catch (const base::Failure&) {
    return "not kept: " + file + " cannot be written";  // no reason to end an attempt
  }
  return "kept as " + file;
}

void Desk::keep_guidance(MonitorPanel& guidance) {
  if (const auto kept = guidance.take_kept())
    guidance.say(keep("guidance", kept->rgb(), kept->width_px(), kept->height_px()));
}

// What became of the sound is said for a moment, where it was turned or cannot be.
void Desk::turn_sound(const Keys& keys) {
  const auto say = [this](std::string words) {
    notice_ = std::move(words);
    notice_until_s_ = session::clock_s() + kNoticeS;
  };
  const double turned = (keys.pressed('=') ? kVolumeStep : 0.0) - (keys.pressed('-') ? kVolumeStep : 0.0);
  if (turned != 0.0) speaker_.set_volume(speaker_.volume() + turned);
  const bool muted = keys.pressed('M') ? !speaker_.muted() : speaker_.muted() && turned <= 0.0;
  if (muted != speaker_.muted()) speaker_.set_muted(muted);
  if (keys.pressed('M') || turned != 0.0)
    say(muted ? "Sound is off (M)"
              : "Sound " + std::to_string(std::lround(100.0 * speaker_.volume())) + " % (M, −, =)");
  const Speaker::State now = speaker_.state();
  if (now == Speaker::State::none && sound_ != now) say("This workstation has no sound device: it is silent");
  sound_ = now;
  if (session::clock_s() < notice_until_s_) draw_notice(notice_, trainer_.screen() == TrainerScreen::attempt);
}

void Desk::go_on() {
  if (trainer_.screen() != TrainerScreen::attempt) return;
  const Keys& keys = window_.poll();
  attempt_.go_on(trainer_, keys, window_.pointer(), attempt_.wheel_is_its(keys) ? window_.take_wheel() : 0.0,
                 other_hands());
}

void Desk::finish(double began_s) {
  if (trainer_.screen() != TrainerScreen::attempt) return;
  while (!attempt_.finished(trainer_, began_s, kHandsEveryS)) go_on();
  attempt_.take_late(trainer_);
}

bool Desk::moves() const noexcept {
  switch (trainer_.screen()) {
    case TrainerScreen::attempt:
    case TrainerScreen::watch:
    case TrainerScreen::devices:
      return true;
    default:
      return false;
  }
}

bool Desk::rests(double now_s) const noexcept {
  return window_.context().software() && !moves() && !window_.touched() && now_s > stirred_s_ + kStirredS;
}

void Desk::await_frame() {
  for (double left_s = due_s_ - session::clock_s(); left_s > 0.0; left_s = due_s_ - session::clock_s()) {
    if (moves()) {
      std::this_thread::sleep_for(std::chrono::duration<double>(std::min(left_s, kHandsEveryS)));
      go_on();
    } else if (window_.wait(left_s)) {
      const double now_s = session::clock_s();
      if (rests(now_s)) due_s_ = now_s;  // what is done is seen at once
      stirred_s_ = now_s;
    }
  }
}

void Desk::frame() {
  await_frame();
  const double began_s = session::clock_s();
  due_s_ = std::max(due_s_ + (window_.hidden() ? kHiddenS : rests(began_s) ? kRestS : between_s_), began_s);
  // In the room, and while one is watched, keys are hands.
  const TrainerScreen up = trainer_.screen();
  window_.begin_frame(up != TrainerScreen::attempt && up != TrainerScreen::watch);
  forget_items();
  const std::string drawn = name_of(trainer_);
  const bool gathers = words_.wanted() && began_s - words_s_ >= kTellEveryS;
  want_words(gathers);
  if (gathers) words_s_ = began_s;
  trainer_.look();
  attempt_.look(trainer_);
  draw_screen();
  turn_sound(window_.keys());
  window_.end_frame();
  finish(began_s);
  std::vector<unsigned char> pixels;
  const bool keeps = window_.keys().pressed(kF12);
  if (window_.keys().alt_enter()) window_.set_whole_screen(!window_.whole_screen());
  window_.show(keeps ? &pixels : nullptr);
  const std::string screen = name_of(trainer_);
  if (gathers) words_.write(words_of(drawn), take_words(), focus());
  if (screen == "attempt") attempt_.shown(trainer_, window_.width_px(), window_.height_px());
  if (keeps) keep("seldinger", pixels, window_.width_px(), window_.height_px());
  keep_guidance(attempt_.guidance());
  keep_guidance(watch_.guidance());
  tell(screen);
  if (screen != told_) stirred_s_ = session::clock_s();
  if (screen != told_) window_.set_title(words_of(trainer_) + " – Seldinger");
  if (screen != told_ && screen == "devices") look_for_space_mouse();  // its daemon may have been started since
  told_ = screen;
}

}  // namespace seldinger::app
