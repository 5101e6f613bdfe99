#include "app/window/screens/panel_watch.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>

#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "reports/words/attempt_words.h"

namespace seldinger::app {
namespace {

constexpr int kHelp = 3;  // who watches sees where it goes
struct Speed {
  double times;
  const char* words;
};
constexpr std::array<Speed, 5> kSpeeds = {{{0.25, "¼ ×"}, {0.5, "½ ×"}, {1.0, "1 ×"}, {2.0, "2 ×"}, {4.0, "4 ×"}}};
constexpr double kFirstS = 0.01;  // before it there is nothing to be seen
constexpr double kLeapS = 5.0, kCaptionS = 3.0, kSideCaptionS = 1.5;
constexpr double kLateS = 0.3, kEarlyS = 0.05;  // of one of two: the other waits; it waits itself
constexpr float kPictureShare = 0.5F;           // of the width; the room, which shows why, has the rest
constexpr float kBelowLetters = 8.7F;           // the course, in heights of a letter
constexpr float kPictureOfSide = 0.62F;         // of the height of one of two; its room has the rest
constexpr float kMarkPx = 9.0F;                 // high

// What the picture that was up then showed.
std::optional<cases::FrameTruth> frame_at(const cases::Recording& recording, double t_s) {
  const auto next = std::upper_bound(recording.frames.begin(), recording.frames.end(), t_s,
                                     [](double t, const cases::FrameTruth& frame) { return t < frame.t_s; });
  if (next == recording.frames.begin()) return std::nullopt;
  return *std::prev(next);
}

std::string who_made(const session::WatchedAttempt& watched) {
  if (watched.live()) return "in the room now, with a few seconds' delay";
  const casedb::AttemptRow& attempt = watched.attempt();
  return attempt.synthetic() ? reports::simulated_operator_text(attempt.operator_name) : "watched again";
}

}  // namespace

// Once it is over it stands where it was fired: the last moment shows needle and target, not an empty picture.
void WatchPanel::take(session::WatchedAttempt& watched, Side& side, bool sounds) {
  const casedb::AttemptRow& attempt = watched.attempt();
  if (side.shown != attempt.attempt_id) {
    side.end();
    side.room.begin(watched.scene(), false);
    side.monitor.begin(watched.scene());
    side.shown = attempt.attempt_id;
  }
  if (const auto moment = watched.moment()) {
    Seen now = side.seen;
    now.moment = *moment;
    if (sounds) speaker_.play(sounds_of(side.seen, now, watched.scene().instrument.kind));
    side.seen.moment = *moment;
  }
  side.seen.frame = frame_at(*watched.recording(), side.seen.moment.state.t_s);
  side.seen.frozen = side.seen.moment.state.probe.frozen;
  watched.monitor().want();
  if (watched.phase() == session::WatchedAttempt::Phase::over && !side.rests && watched.fired_s()) {
    side.rests = true;
    watched.set_speed(0.0);
    watched.go_to(*watched.fired_s());
  }
}

bool WatchPanel::over(Trainer& trainer) const {
  if (trainer.beside() != nullptr) return at_s_ >= to_s_;
  return one_.rests || trainer.watched()->phase() == session::WatchedAttempt::Phase::over;
}

void WatchPanel::go_to(Trainer& trainer, double t_s) {
  one_.rests = beside_.rests = false;
  if (trainer.beside() == nullptr) return trainer.watched()->go_to(t_s);
  at_s_ = std::clamp(t_s, from_s_, to_s_);
  trainer.watched()->go_to(std::max(kFirstS, at_s_ + one_.shift_s));
  trainer.beside()->go_to(std::max(kFirstS, at_s_ + beside_.shift_s));
}

void WatchPanel::set_speed(Trainer& trainer, double speed) {
  speed_ = speed;
  if (trainer.beside() == nullptr) trainer.watched()->set_speed(speed);
}

// What happened, as strokes: what spoke against the attempt is red.
void WatchPanel::draw_marks(const session::WatchedAttempt& watched, double shift_s, double from_s, double to_s,
                            float y, float left, float width) const {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 mouse = ImGui::GetMousePos();
  for (const assessment::ReplayMark& mark : watched.marks()) {
    const float x =
        left + width * static_cast<float>(std::clamp((mark.t_s - shift_s - from_s) / (to_s - from_s), 0.0, 1.0));
    draw->AddLine({x, y}, {x, y + kMarkPx}, mark.fault ? IM_COL32(245, 120, 90, 255) : IM_COL32(158, 219, 247, 255),
                  2.0F);
    if (std::abs(mouse.x - x) < 4.0F && mouse.y >= y - 2.0F && mouse.y <= y + kMarkPx + 2.0F)
      ImGui::SetTooltip("%s", mark.words.c_str());
  }
}

void WatchPanel::draw_course(Trainer& trainer, const Keys& keys) {
  session::WatchedAttempt& watched = *trainer.watched();
  session::WatchedAttempt* const beside = trainer.beside();
  const double t_s = beside != nullptr ? at_s_ : one_.seen.moment.state.t_s;
  const double from_s = beside != nullptr ? from_s_ : 0.0;
  const double to_s = beside != nullptr ? to_s_ : std::max(0.1, watched.duration_s());
  if (beside == nullptr) {
    std::string said = assessment::words_at(watched.marks(), t_s, kCaptionS);
    if (one_.rests) said = "Over: this is the moment of firing.";
    heading(said.empty() ? " " : said.c_str());
    if (!said.empty()) note_item(("Caption: " + said).c_str());
  }
  char words[64];
  std::snprintf(words, sizeof words, "%%.0f of %.0f s", to_s);
  auto at_s = static_cast<float>(std::clamp(t_s, from_s, to_s));
  ImGui::SetNextItemWidth(-1.0F);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const float wide = ImGui::GetContentRegionAvail().x;
  if (ImGui::SliderFloat("##time", &at_s, static_cast<float>(from_s), static_cast<float>(to_s), words))
    go_to(trainer, static_cast<double>(at_s));
  note_item("time");
  const float y = corner.y + ImGui::GetFrameHeight() + 1.0F;
  ImGui::Dummy({wide, beside != nullptr ? 2.0F * kMarkPx + 2.0F : kMarkPx});
  note_item("marks");
  draw_marks(watched, beside != nullptr ? one_.shift_s : 0.0, from_s, to_s, y, corner.x, wide);
  if (beside != nullptr) draw_marks(*beside, beside_.shift_s, from_s, to_s, y + kMarkPx + 2.0F, corner.x, wide);
  const bool ended = over(trainer), standing = (beside != nullptr ? speed_ : watched.speed()) <= 0.0;
  if (noted_button(ended      ? "From the beginning (Space)"
                   : standing ? "Go on (Space)"
                              : "Stop (Space)") ||
      keys.pressed(kSpace)) {
    if (ended) go_to(trainer, from_s);
    set_speed(trainer, ended || standing ? 1.0 : 0.0);
  }
  const double speed = beside != nullptr ? speed_ : watched.speed();
  for (const Speed& one : kSpeeds) {
    ImGui::SameLine();
    const bool chosen = one.times == speed;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    if (noted_button(one.words)) set_speed(trainer, one.times);
    if (chosen) ImGui::PopStyleColor();
  }
  ImGui::SameLine();
  if (ImGui::Button("Back 5 s (Left)") || keys.pressed(kLeft)) go_to(trainer, t_s - kLeapS);
  ImGui::SameLine();
  if (ImGui::Button("On 5 s (Right)") || keys.pressed(kRight)) go_to(trainer, t_s + kLeapS);
  // Whoever may not has to find the way by the pictures.
  if (beside == nullptr && trainer.may(casedb::Action::look_inside)) {
    constexpr std::array kInside = {"Cut away (I)", "Look through (I)", "Whole (I)"};
    ImGui::SameLine();
    if (ImGui::Button(kInside[static_cast<std::size_t>(one_.room.inside())]) || keys.pressed('I'))
      one_.room.look_inside(watched.kept_scene());
  }
  ImGui::SameLine();
}

// Of a live attempt, by whoever may: what the patient is to do there.
void WatchPanel::draw_events(Trainer& trainer) {
  if (!trainer.may_cause()) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Make happen:");
  for (const cases::EventInfo& event : cases::event_kinds()) {
    if (event.source != cases::EventSource::mentor) continue;
    ImGui::SameLine();
    if (noted_button(event.words)) trainer.cause(event.kind);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("within a few seconds, in the trainee's room");
  }
}

void WatchPanel::draw_alone(session::WatchedAttempt& watched, const Keys& keys) {
  heading((watched.attempt().case_title + " – " + who_made(watched)).c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", kTrainingOnly);
  const ImVec2 all = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorPos();
  const float below = kBelowLetters * ImGui::GetFontSize(), high = all.y - below - kBetweenPartsPx;
  const float right = kPictureShare * all.x, left = all.x - right - kBetweenPartsPx;
  const float console = one_.monitor.console_height(right, nullptr);
  begin_part("room", {0.0F, 0.0F, left, high}, corner.x, corner.y);
  one_.room.place(watched.scene(), one_.seen, keys, elapsed_s_);
  one_.room.draw(watched.scene(), one_.seen, kHelp);
  one_.room.draw_views();
  ImGui::EndChild();
  begin_part("guidance", {left + kBetweenPartsPx, 0.0F, right, high - console - kBetweenPartsPx}, corner.x,
             corner.y);
  one_.monitor.draw(watched.monitor(), one_.seen, true, keys, nullptr);
  ImGui::EndChild();
  begin_part("console", {left + kBetweenPartsPx, high - console, right, console}, corner.x, corner.y);
  one_.monitor.draw_console(watched.monitor(), one_.seen, nullptr);
  ImGui::EndChild();
  ImGui::SetCursorPos({corner.x, corner.y + high + kBetweenPartsPx});
}

// Times are common where both needles go through the skin; where one never did, where both begin.
void WatchPanel::begin_both(session::WatchedAttempt& one, session::WatchedAttempt& beside) {
  const bool punctured = one.punctured_s() && beside.punctured_s();
  one_.shift_s = 0.0;
  beside_.shift_s = punctured ? *beside.punctured_s() - *one.punctured_s() : 0.0;
  from_s_ = std::min(0.0, -beside_.shift_s);
  to_s_ = std::max(one.duration_s(), beside.duration_s() - beside_.shift_s);
  at_s_ = from_s_;
  speed_ = 1.0;
  one.go_to(std::max(kFirstS, at_s_));
  beside.go_to(std::max(kFirstS, at_s_ + beside_.shift_s));
}

// Kept to the common time: whoever is ahead waits.
void WatchPanel::lead(session::WatchedAttempt& watched, const Side& side) {
  const double due_s = std::clamp(at_s_ + side.shift_s, 0.0, watched.duration_s());
  const double ahead_s = side.seen.moment.state.t_s - due_s;
  watched.set_speed(side.rests || ahead_s > kEarlyS || due_s <= 0.0 ? 0.0 : speed_);
}

void WatchPanel::draw_side(session::WatchedAttempt& watched, Side& side, const Part& part, float left, float top,
                           const char* who, const Keys& keys) {
  ImGui::SetCursorPos({left + part.left, top + part.top});
  ImGui::BeginGroup();
  heading(who);
  note_item(who);
  const std::string said = side.rests
                               ? "this is the moment of firing"
                               : assessment::words_at(watched.marks(), side.seen.moment.state.t_s, kSideCaptionS);
  ImGui::SameLine();
  ImGui::PushTextWrapPos(left + part.left + part.width);
  ImGui::TextUnformatted(said.c_str());
  ImGui::PopTextWrapPos();
  if (!said.empty()) note_item((std::string(who) + ": " + said).c_str());
  ImGui::EndGroup();
  const float words = 2.0F * ImGui::GetTextLineHeightWithSpacing();
  const float picture = kPictureOfSide * (part.height - words);
  Part place{part.left, part.top + words, part.width, picture};
  begin_part((std::string("guidance of ") + who).c_str(), place, left, top);
  side.monitor.draw(watched.monitor(), side.seen, true, keys, nullptr);
  ImGui::EndChild();
  place.top += picture + kBetweenPartsPx;
  place.height = part.height - words - picture - kBetweenPartsPx;
  begin_part((std::string("room of ") + who).c_str(), place, left, top);
  side.room.place(watched.scene(), side.seen, keys, elapsed_s_);
  side.room.draw(watched.scene(), side.seen, kHelp);
  side.room.draw_views();
  ImGui::EndChild();
}

void WatchPanel::draw_both(Trainer& trainer, const Keys& keys) {
  session::WatchedAttempt &one = *trainer.watched(), &beside = *trainer.beside();
  const auto late = [&](const session::WatchedAttempt& watched, const Side& side) {
    const double due_s = std::clamp(at_s_ + side.shift_s, 0.0, watched.duration_s());
    return !side.rests && side.seen.moment.state.t_s < due_s - kLateS;
  };
  if (!late(one, one_) && !late(beside, beside_)) at_s_ = std::min(to_s_, at_s_ + speed_ * elapsed_s_);
  lead(one, one_);
  lead(beside, beside_);
  heading((one.attempt().case_title + " – yours beside an expert’s" +
           (one.punctured_s() && beside.punctured_s() ? ", both through the skin at once" : ""))
              .c_str());
  const ImVec2 all = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorPos();
  const float high = all.y - kBelowLetters * ImGui::GetFontSize(), half = 0.5F * (all.x - kBetweenPartsPx);
  draw_side(one, one_, {0.0F, 0.0F, half, high}, corner.x, corner.y, "Yours", keys);
  const std::string expert = beside.attempt().synthetic() ? who_made(beside) : "An expert";
  draw_side(beside, beside_, {half + kBetweenPartsPx, 0.0F, half, high}, corner.x, corner.y, expert.c_str(), keys);
  ImGui::SetCursorPos({corner.x, corner.y + high + kBetweenPartsPx});
}

void WatchPanel::draw(Trainer& trainer, const Keys& keys) {
  begin_screen("watch");
  session::WatchedAttempt& watched = *trainer.watched();
  session::WatchedAttempt* const beside = trainer.beside();
  const auto preparing = [](const session::WatchedAttempt& one) {
    return one.phase() == session::WatchedAttempt::Phase::preparing ||
           one.phase() == session::WatchedAttempt::Phase::refused;
  };
  const double now_s = session::clock_s();
  elapsed_s_ = std::min(0.1, now_s - drawn_s_);
  drawn_s_ = now_s;
  if (preparing(watched) || (beside != nullptr && preparing(*beside))) {
    heading(beside != nullptr ? "Preparing both attempts …" : "Preparing the attempt …");
    ImGui::ProgressBar(static_cast<float>(std::fmod(ImGui::GetTime(), 1.0)), {scaled(220.0F), 0.0F}, "");
  } else {
    const bool begins = one_.shown != watched.attempt().attempt_id;
    take(watched, one_, true);
    if (beside != nullptr) {
      if (begins) begin_both(watched, *beside);
      take(*beside, beside_, false);
      draw_both(trainer, keys);
    } else {
      draw_alone(watched, keys);
    }
    draw_course(trainer, keys);
  }
  if (noted_button("Back (Esc)") || keys.pressed(kEscape)) trainer.stop_watching();
  draw_events(trainer);
  end_screen();
}

}  // namespace seldinger::app
