#include "app/window/screens/panel_watch.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "app/window/screens/panels.h"
#include "reports/words/attempt_words.h"

namespace seldinger::app {
namespace {

constexpr int kHelp = 3;  // who watches sees where it goes
constexpr std::array<double, 3> kSpeeds = {1.0, 2.0, 4.0};
constexpr double kLeapS = 5.0;
constexpr float kPictureShare = 0.5F;  // of the width; the room, which shows why, has the rest
constexpr float kBelowLetters = 9.5F;  // the course, in heights of a letter

// What was said or happened last, for a few seconds.
std::string said_at(const cases::Recording& recording, double t_s) {
  constexpr double kShownS = 3.0;
  std::string said;
  for (const cases::Event& event : recording.events.value_or(std::vector<cases::Event>{}))
    if (event.t_s <= t_s && t_s < event.t_s + kShownS)
      if (const cases::EventInfo* info = cases::find_event(event.kind)) said = info->words;
  return said;
}

// What the picture that was up then showed.
std::optional<cases::FrameTruth> frame_at(const cases::Recording& recording, double t_s) {
  const auto next = std::upper_bound(recording.frames.begin(), recording.frames.end(), t_s,
                                     [](double t, const cases::FrameTruth& frame) { return t < frame.t_s; });
  if (next == recording.frames.begin()) return std::nullopt;
  return *std::prev(next);
}

}  // namespace

void WatchPanel::draw_course(Trainer& trainer, const Keys& keys) {
  session::WatchedAttempt& watched = *trainer.watched();
  const double t_s = seen_.moment.state.t_s, all_s = std::max(0.1, watched.duration_s());
  char words[64];
  std::snprintf(words, sizeof words, "%%.0f of %.0f s", all_s);
  auto at_s = static_cast<float>(std::min(t_s, all_s));
  ImGui::SetNextItemWidth(-1.0F);
  if (ImGui::SliderFloat("##time", &at_s, 0.0F, static_cast<float>(all_s), words)) watched.go_to(at_s);
  const bool over = watched.phase() == session::WatchedAttempt::Phase::over, standing = watched.speed() <= 0.0;
  if (ImGui::Button(over       ? "From the beginning (Space)"
                    : standing ? "Go on (Space)"
                               : "Stop (Space)") ||
      keys.pressed(kSpace)) {
    if (over) watched.go_to(0.0);
    watched.set_speed(over || standing ? 1.0 : 0.0);
  }
  for (const double speed : kSpeeds) {
    ImGui::SameLine();
    std::snprintf(words, sizeof words, "%.0f ×", speed);
    if (ImGui::Button(words)) watched.set_speed(speed);
  }
  ImGui::SameLine();
  if (ImGui::Button("Back 5 s (Left)") || keys.pressed(kLeft)) watched.go_to(t_s - kLeapS);
  ImGui::SameLine();
  if (ImGui::Button("On 5 s (Right)") || keys.pressed(kRight)) watched.go_to(t_s + kLeapS);
  // Whoever may not has to find the way by the pictures.
  if (trainer.may(casedb::Action::look_inside)) {
    constexpr std::array kInside = {"Cut away (I)", "Look through (I)", "Whole (I)"};
    ImGui::SameLine();
    if (ImGui::Button(kInside[static_cast<std::size_t>(room_.inside())]) || keys.pressed('I'))
      room_.look_inside(watched.kept_scene());
  }
  const std::string said = said_at(watched.recording(), t_s);
  ImGui::TextDisabled("%s", said.empty() ? " " : said.c_str());
}

void WatchPanel::draw(Trainer& trainer, const Keys& keys) {
  begin_screen("watch");
  session::WatchedAttempt& watched = *trainer.watched();
  if (watched.phase() == session::WatchedAttempt::Phase::preparing) {
    heading("The attempt is being prepared …");
    ImGui::ProgressBar(static_cast<float>(std::fmod(ImGui::GetTime(), 1.0)), {scaled(220.0F), 0.0F}, "");
  } else {
    const casedb::AttemptRow& attempt = watched.attempt();
    if (shown_ != attempt.attempt_id) {
      room_.begin(watched.scene(), false);
      monitor_.begin(watched.scene());
      seen_ = {};
      shown_ = attempt.attempt_id;
    }
    if (const auto moment = watched.moment()) {
      Seen now = seen_;
      now.moment = *moment;
      speaker_.play(sounds_of(seen_, now, watched.scene().instrument.kind));
      seen_.moment = *moment;
    }
    seen_.frame = frame_at(watched.recording(), seen_.moment.state.t_s);
    watched.monitor().want();
    seen_.frozen = seen_.moment.state.probe.frozen;
    heading((attempt.case_title + " – " +
             (attempt.synthetic() ? reports::simulated_operator_text(attempt.operator_name) : "watched again"))
                .c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%s", kTrainingOnly);
    const ImVec2 all = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorPos();
    const float below = kBelowLetters * ImGui::GetFontSize(), high = all.y - below - kBetweenPartsPx;
    const float right = kPictureShare * all.x, left = all.x - right - kBetweenPartsPx;
    const float console = monitor_.console_height(right, nullptr);
    begin_part("room", {0.0F, 0.0F, left, high}, corner.x, corner.y);
    const double now_s = session::clock_s();
    room_.place(watched.scene(), seen_, keys, std::min(0.1, now_s - drawn_s_));
    room_.draw(watched.scene(), seen_, kHelp);
    room_.draw_views();
    drawn_s_ = now_s;
    ImGui::EndChild();
    begin_part("guidance", {left + kBetweenPartsPx, 0.0F, right, high - console - kBetweenPartsPx}, corner.x,
               corner.y);
    monitor_.draw(watched.monitor(), seen_, true, keys, nullptr);
    ImGui::EndChild();
    begin_part("console", {left + kBetweenPartsPx, high - console, right, console}, corner.x, corner.y);
    monitor_.draw_console(watched.monitor(), seen_, nullptr);
    ImGui::EndChild();
    ImGui::SetCursorPos({corner.x, corner.y + high + kBetweenPartsPx});
    draw_course(trainer, keys);
  }
  if (ImGui::Button("Back (Esc)") || keys.pressed(kEscape)) trainer.stop_watching();
  end_screen();
}

}  // namespace seldinger::app
