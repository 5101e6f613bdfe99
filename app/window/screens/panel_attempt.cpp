#include "app/window/screens/panel_attempt.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <thread>

#include "app/window/hands/act_words.h"
#include "app/window/hands/frame_plan.h"
#include "app/window/screens/panel_device.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "reports/words/attempt_words.h"

namespace seldinger::app {
namespace {

using cases::EventKind;

// The meters' full scale (design): a needle that is stopped by capsule or skin, a probe that is pressed hard.
constexpr double kMostNeedleN = 6.0, kMostProbeN = 15.0;

// What came at once, a notch or what a slow frame kept, is given out as by a window of 60 frames a second.
constexpr double kLeastBetweenS = 1.0 / 60.0;
constexpr double kMostTicksS = 0.003;  // a tick and a half, and what a servo may be late
constexpr double kLookAgainS = 0.0005;
constexpr float kLeastActsPx = 90.0F;
constexpr float kMostConsoleShare =
    0.12F;                        // of the window's height: one that is higher is folded until it is asked for
constexpr double kLagOver = 0.9;  // of a lag that is shown, what was before counts so much

void meter(const char* label, double force_n, double most_n) {
  char words[48];
  std::snprintf(words, sizeof words, "%s %.1f N", label, std::max(0.0, force_n));
  const float share = static_cast<float>(std::clamp(force_n / most_n, 0.0, 1.0));
  ImGui::PushStyleColor(ImGuiCol_PlotHistogram, ImVec4(0.30F + 0.6F * share, 0.75F - 0.4F * share, 0.40F, 1.0F));
  ImGui::ProgressBar(share, {-1.0F, 0.0F}, words);
  ImGui::PopStyleColor();
}

}  // namespace

void AttemptPanel::begin(Trainer& trainer) {
  if (trainer.begin(options_.left_handed)) set_up(trainer);
}

void AttemptPanel::resume(Trainer& trainer) {
  resuming_ = trainer.resume(options_.left_handed) || resuming_;
}

void AttemptPanel::look(Trainer& trainer) {
  if (!resuming_ || trainer.resuming()) return;
  resuming_ = false;
  if (trainer.screen() == TrainerScreen::attempt) set_up(trainer);
}

void AttemptPanel::set_up(Trainer& trainer) {
  const cases::Case& scene = trainer.attempt()->task()->scene;
  room_.begin(scene, options_.left_handed);
  monitor_.begin(scene);
  seen_ = {};
  arms_ = {};
  by_led_arms_ = trainer.arms() && trainer.arms()->led;
  told_ = {};
  told_.fluoroscope.pulse_rate = 1;
  told_s_ = drawn_s_ = session::clock_s();
  room_lag_s_ = picture_lag_s_ = 0.0;
  method_ = trainer.attempt()->monitor().method();
  frames_s_ = room_told_s_ = 0.0;
  pictures_ = pictures_told_ = 0;
  watch_.begin(scene.picture.modality);
  acts_.begin(*trainer.attempt(), trainer.plan());
  fired_ = leaving_ = false;
  at_fire_.clear();
}

void AttemptPanel::keep_picture() {
  const session::GreyPicture& shown = monitor_.shown().picture;
  if (shown.width_px > 0) at_fire_.show(shown.width_px, shown.height_px, shown.grey);
}

void AttemptPanel::read_keys(Trainer& trainer, const Keys& keys) {
  PersonAttempt& attempt = *trainer.attempt();
  acts_.read_keys(attempt, seen_, flipped(), keys);
  if (keys.pressed(kEscape)) {
    leaving_ = !leaving_;
    attempt.pause(leaving_);
  }
  for (int view = 0; view < static_cast<int>(imaging::kRoomViewNames.size()); ++view)
    if (keys.pressed('1' + view)) room_.set_view(static_cast<imaging::RoomView>(view));
  if (keys.pressed(kF1 + 9)) arms_live_ = !arms_live_;
  if (keys.pressed(kF1 + 10)) room_.set_stereo(!room_.stereo());
  if (keys.pressed(kEnter)) picture_first_ = !picture_first_;
  if (keys.pressed(kHomeKey)) console_asked_ = !console_shown_;
}

void AttemptPanel::draw_top(Trainer& trainer) {
  const cases::State& state = seen_.moment.state;
  heading(trainer.chosen().title.c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("%s", kTrainingOnly);
  char words[64];
  std::snprintf(words, sizeof words, "%d:%02d   %s", static_cast<int>(state.t_s) / 60,
                static_cast<int>(state.t_s) % 60, trainer.account().login_name.c_str());
  ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(words).x);
  ImGui::TextUnformatted(words);
}

// Where the window's parts can be changed: by a button and its key.
void AttemptPanel::draw_choices() {
  const char* swap = picture_first_ ? "Room larger (Enter)" : "Picture larger (Enter)";
  const char* console = console_shown_ ? "Fold console (Home)" : "Console (Home)";
  if (noted_button(swap)) picture_first_ = !picture_first_;
  const ImGuiStyle& style = ImGui::GetStyle();
  const float both = ImGui::CalcTextSize(swap).x + ImGui::CalcTextSize(console).x + 4.0F * style.FramePadding.x +
                     style.ItemSpacing.x;
  if (both <= ImGui::GetContentRegionAvail().x) ImGui::SameLine();
  if (noted_button(console)) console_asked_ = !console_shown_;
}

// What the patient does, over the room, as long as one would hear it.
void AttemptPanel::draw_reaction() {
  constexpr double kShownS = 2.5;
  const engine::Moment& moment = seen_.moment;
  if (moment.reaction == EventKind::none || moment.state.t_s > moment.reaction_t_s + kShownS) return;
  const cases::EventInfo* info = cases::find_event(moment.reaction);
  if (info == nullptr) return;
  const std::string words = std::string("Patient: ") + info->words;
  const ImVec2 corner = ImGui::GetWindowPos(), size = ImGui::CalcTextSize(words.c_str());
  const ImVec2 at{corner.x + 20.0F, corner.y + 20.0F + ImGui::GetFrameHeight()};  // below the view's button
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({at.x - 12.0F, at.y - 6.0F}, {at.x + size.x + 12.0F, at.y + size.y + 6.0F},
                      IM_COL32(120, 40, 30, 220), 6.0F);
  draw->AddText(at, IM_COL32(255, 240, 230, 255), words.c_str());
  note_place("reaction", at.x - 12.0F, at.y - 6.0F, size.x + 24.0F, size.y + 12.0F);
}

void AttemptPanel::tell(TraceLine& line) {
  line.pictures_s =
      static_cast<double>(pictures_ - pictures_told_);  // of so long; a rate by whoever knows how long
  pictures_told_ = pictures_;
  line.method = method_;
  line.hand_to_force_ms = 1e3 * hand_to_force_s_;
  line.hand_to_room_ms = 1e3 * hand_to_room_s_;
  line.hand_to_picture_ms = 1e3 * hand_to_picture_s_;
  hand_to_force_s_ = hand_to_room_s_ = hand_to_picture_s_ = 0.0;
  line.held = seen_.held == devices::HeldTool::needle ? "needle" : "probe";
  line.inserted_mm = seen_.inserted_mm;
  line.press_mm = seen_.press_mm;
  line.attempt_s = seen_.moment.state.t_s;
  line.fired = seen_.moment.state.fire.fired;
  line.console = monitor_.shown().console;
  // As asked: a picture does not tell where colour's box is.
  line.console.lean_deg = told_.console.lean_deg;
  line.console.box_across = told_.console.box_across;
  line.console.box_down = told_.console.box_down;
  line.gain_db = monitor_.knobs().screen.gain_db;
  line.needle_lps_mm = seen_.moment.state.needle.tip_lps_mm;
  line.probe_lps_mm = seen_.moment.state.probe.origin_lps_mm;
  if (seen_.arms.used)
    for (const haptics::Side side : {haptics::Side::left, haptics::Side::right})
      line.arms.emplace_back(arm_state(seen_.arms, side));
}

void AttemptPanel::shown(Trainer& trainer, int width_px, int height_px) {
  ConditionWatch::Frame frame;
  frame.now_s = session::clock_s();
  const auto lately = [](double& lag_s, double newest_s) {
    lag_s = lag_s > 0.0 ? kLagOver * lag_s + (1.0 - kLagOver) * newest_s : newest_s;
  };
  hand_to_force_s_ = std::max(hand_to_force_s_, seen_.hand_to_force_s);
  if (seen_.moment.told_s > room_told_s_) {
    room_told_s_ = seen_.moment.told_s;
    frame.force_lag_s = seen_.hand_to_force_s;
    frame.room_lag_s = frame.now_s - room_told_s_;
    lately(room_lag_s_, *frame.room_lag_s);
    hand_to_room_s_ = std::max(hand_to_room_s_, *frame.room_lag_s);
  }
  const session::ShownPicture& shown = monitor_.shown();
  frame.new_picture = shown.number != 0 && shown.number != pictures_;
  if (frame.new_picture) {
    pictures_ = shown.number;
    if (shown.live && shown.told_s > 0.0) {
      frame.picture_lag_s = frame.now_s - shown.told_s;
      lately(picture_lag_s_, *frame.picture_lag_s);
      hand_to_picture_s_ = std::max(hand_to_picture_s_, *frame.picture_lag_s);
    }
  }
  frame.sound = !speaker_.muted() && speaker_.volume() > 0.0 && speaker_.state() != Speaker::State::none;
  frame.stereo = room_.stereo();
  frame.width_px = width_px;
  frame.height_px = height_px;
  tell_conditions(*trainer.attempt(), frame);
}

void AttemptPanel::tell_conditions(PersonAttempt& attempt, ConditionWatch::Frame& frame) {
  frame.paused = attempt.paused();
  watch_.shown(frame);
  watch_.made_by(method_);
  if (watch_.due(frame.now_s))
    attempt.know([this](casedb::Conditions& conditions) { watch_.put_into(conditions); });
}

void AttemptPanel::draw_arms() {
  const ArmsSaid said = arms_words(seen_.arms);
  ImGui::PushTextWrapPos(0.0F);
  if (said.warns)
    ImGui::TextColored({1.0F, 0.62F, 0.35F, 1.0F}, "%s", said.words.c_str());
  else
    ImGui::TextDisabled("%s", said.words.c_str());
  ImGui::PopTextWrapPos();
  note_item(said.words.c_str());
}

void AttemptPanel::draw_arms_live(PersonAttempt& attempt) {
  if (const auto newest = attempt.arms_seen()) arms_ = *newest;
  if (!arms_live_ || !seen_.arms.used) return;
  // In the lower left corner, where a sector has nothing.
  const float width = scaled(560.0F), height = scaled(200.0F), hands = scaled(168.0F);
  ImGui::SetNextWindowPos({14.0F, ImGui::GetMainViewport()->WorkSize.y - hands - height}, ImGuiCond_Appearing);
  ImGui::SetNextWindowSize({width, height}, ImGuiCond_Appearing);
  if (ImGui::Begin("The arms, live (F10)", &arms_live_,
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoCollapse |
                       ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse |
                       ImGuiWindowFlags_NoFocusOnAppearing))
    draw_arm_traces(arms_, ImGui::GetContentRegionAvail().y);
  ImGui::End();
}

// A thrown tip is deeper than the hand has pushed, and comes out last.
void AttemptPanel::draw_depth(const cases::Instrument& instrument) {
  const cases::State& state = seen_.moment.state;
  const bool fired = state.fire.fired, in = fired ? state.needle.skin.in_body : seen_.inserted;
  char depth[64];
  std::snprintf(depth, sizeof depth, "%.0f mm of the needle is in",
                fired ? state.needle.inserted_mm : seen_.inserted_mm);
  const std::string words =
      (fired ? fire_words(instrument) + "; " : std::string()) + (in ? depth : "the needle is outside");
  if (seen_.by_mouse || by_led_arms_) {  // beside what is in the hand, where there is room
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < ImGui::CalcTextSize(("· " + words).c_str()).x) ImGui::NewLine();
  }
  ImGui::Text("· %s", words.c_str());
  note_item(words.c_str());
}

void AttemptPanel::draw_hands(const session::Task& task) {
  if (seen_.arms.used) draw_arms();
  const engine::Moment& moment = seen_.moment;
  // An arm's tool is in the hand at the arm.
  if (seen_.by_mouse || by_led_arms_) {
    const std::string words = in_hand_words(seen_, task.scene.picture.modality);
    ImGui::TextUnformatted(words.c_str());
    note_item(words.c_str());
  }
  draw_depth(task.scene.instrument);
  if (moment.force) {
    meter("needle", moment.force->needle_axial_n, kMostNeedleN);
    if (task.scene.picture.modality != cases::Modality::xray) meter("probe", moment.force->probe_n, kMostProbeN);
  }
  draw_choices();
  quiet(task.scene.instrument.kind == cases::InstrumentKind::core
            ? "drag: move · right drag: turn · wheel: push · Shift: fine · Space: fire · F: freeze · Alt: camera"
            : "drag: move · right drag: turn · wheel: push · Shift: fine · Space: I am there · F: freeze · Alt: "
              "camera");
}

void AttemptPanel::see(PersonAttempt& attempt) {
  if (const auto seen = attempt.seen()) {
    speaker_.play(sounds_of(seen_, *seen, attempt.task()->scene.instrument.kind));
    seen_ = *seen;
  }
}

// What was told is in one of the next ticks: worth more than drawing a moment that does not know of it.
void AttemptPanel::see_told(PersonAttempt& attempt) {
  const double until_s = session::clock_s() + kMostTicksS;
  for (see(attempt); seen_.moment.told_s < told_.told_s && session::clock_s() < until_s; see(attempt))
    std::this_thread::sleep_for(std::chrono::microseconds(100));
}

void AttemptPanel::read_hands(PersonAttempt& attempt, const Keys& keys, const Pointer& pointer, double wheel,
                              const OtherHands& other) {
  const double now_s = session::clock_s(), elapsed_s = now_s - told_s_;
  devices::HandIntent sum = told_.sum;
  told_.by = room_.hands(seen_, keys, pointer, wheel, other, elapsed_s, sum).value_or(told_.by);
  told_s_ = now_s;
  if (attempt.phase() != PersonAttempt::Phase::running || attempt.paused()) return;
  told_.sum = sum;
  told_.between_s = std::max(elapsed_s, kLeastBetweenS);
  told_.told_s = now_s;
  attempt.tell(told_);
}

void AttemptPanel::go_on(Trainer& trainer, const Keys& keys, const Pointer& pointer, double wheel,
                         const OtherHands& other) {
  if (trainer.attempt() != nullptr) read_hands(*trainer.attempt(), keys, pointer, wheel, other);
}

bool AttemptPanel::finished(Trainer& trainer, double began_s, double most_s) {
  if (!room_.finished(most_s)) return false;
  PersonAttempt* attempt = trainer.attempt();
  if (attempt == nullptr || attempt->phase() != PersonAttempt::Phase::running || attempt->monitor().fresh())
    return true;
  const double now_s = session::clock_s(),
               until_s = wait_for_picture_until_s(attempt->monitor().expected_s(), began_s);
  if (now_s >= until_s) return true;
  std::this_thread::sleep_for(std::chrono::duration<double>(std::min({kLookAgainS, most_s, until_s - now_s})));
  return false;
}

void AttemptPanel::take_late(Trainer& trainer) {
  PersonAttempt* attempt = trainer.attempt();
  if (attempt != nullptr && attempt->phase() == PersonAttempt::Phase::running)
    monitor_.take_late(attempt->monitor());
}

void AttemptPanel::draw_rates() {
  char words[96];
  std::snprintf(words, sizeof words, "%.0f /s   behind the hand: room %.0f ms, picture %.0f ms", frames_s_,
                1e3 * room_lag_s_, 1e3 * picture_lag_s_);
  const auto fits = [&] { return ImGui::CalcTextSize(words).x <= ImGui::GetWindowSize().x - 16.0F; };
  if (!fits())
    std::snprintf(words, sizeof words, "%.0f /s   room %.0f, picture %.0f ms behind", frames_s_, 1e3 * room_lag_s_,
                  1e3 * picture_lag_s_);
  if (!fits()) std::snprintf(words, sizeof words, "%.0f /s   %.0f ms behind", frames_s_, 1e3 * picture_lag_s_);
  const ImVec2 window = ImGui::GetWindowPos(), size = ImGui::CalcTextSize(words);
  const ImVec2 corner{window.x + 8.0F, window.y + ImGui::GetWindowSize().y - size.y - 6.0F};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled({corner.x - 4.0F, corner.y - 2.0F}, {corner.x + size.x + 4.0F, corner.y + size.y + 2.0F},
                      IM_COL32(236, 240, 243, 190), 3.0F);  // the room may be dark there
  draw->AddText(corner, IM_COL32(40, 50, 60, 255), words);
}

void AttemptPanel::draw_pause(Trainer& trainer) {
  PersonAttempt& attempt = *trainer.attempt();
  ImGui::OpenPopup("Paused");
  if (!ImGui::BeginPopupModal("Paused", nullptr, ImGuiWindowFlags_AlwaysAutoResize)) return;
  ImGui::TextUnformatted("Time is stopped, and the hands are still.");
  if (ImGui::Button("Go on (Esc)", {-1.0F, 0.0F})) {
    leaving_ = false;
    attempt.pause(false);
    ImGui::CloseCurrentPopup();
  }
  const bool again = ImGui::Button("Begin again (F5)", {-1.0F, 0.0F});
  const bool stop = ImGui::Button("Stop; what was done is kept", {-1.0F, 0.0F});
  if (again || stop) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  if (stop) attempt.end();
  if (again) trainer.again();
}

// What is said keeps its height as long as it is as wide.
AttemptLayout AttemptPanel::lay_out() {
  const ImVec2 all = ImGui::GetContentRegionAvail();
  const float letters = scaled(1.0F);
  const AttemptLayout bare = attempt_layout(all.x, all.y, letters, 0.0F, 0.0F);
  if (bare.acts.width != acts_for_px_) acts_px_ = kLeastActsPx * letters;
  acts_for_px_ = bare.acts.width;
  const float console_px = monitor_.console_height(bare.main.width, &told_);
  console_shown_ = console_asked_.value_or(console_px < kMostConsoleShare * all.y);
  return attempt_layout(all.x, all.y, letters, console_shown_ ? console_px : 0.0F, acts_px_);
}

void AttemptPanel::draw(Trainer& trainer, const Keys& keys, const Pointer& pointer, const OtherHands& other) {
  PersonAttempt& attempt = *trainer.attempt();
  const std::shared_ptr<const session::Task> kept = attempt.task();
  const session::Task& task = *kept;
  see(attempt);
  if (seen_.moment.state.fire.fired && !fired_) {
    fired_ = true;
    keep_picture();
  }
  const double now_s = session::clock_s(), elapsed_s = std::min(0.1, now_s - drawn_s_);
  if (now_s > drawn_s_) frames_s_ = 0.9 * frames_s_ + 0.1 / (now_s - drawn_s_);
  drawn_s_ = now_s;
  const bool running = attempt.phase() == PersonAttempt::Phase::running;

  begin_screen("attempt");
  draw_top(trainer);
  const ImVec2 corner = ImGui::GetCursorPos();
  const AttemptLayout parts = lay_out();
  const Part& of_room = picture_first_ ? parts.inset : parts.main;
  const Part& of_picture = picture_first_ ? parts.main : parts.inset;
  begin_part("room", of_room, corner.x, corner.y);
  room_.place(task.scene, seen_, keys, elapsed_s);
  read_hands(attempt, keys, pointer, ImGui::GetIO().MouseWheel, other);
  if (running && !attempt.paused()) see_told(attempt);
  attempt.monitor().want();
  method_ = attempt.monitor().method();
  room_.draw(task.scene, seen_, trainer.help());
  draw_reaction();
  draw_rates();
  room_.draw_views();
  ImGui::EndChild();
  begin_part("guidance", of_picture, corner.x, corner.y);
  monitor_.draw(attempt.monitor(), seen_, trainer.help() > 0, keys, &told_);
  if (const auto depth_mm = monitor_.take_depth_mm(); depth_mm && running)
    acts_.note_measured(attempt, seen_, *depth_mm);
  ImGui::EndChild();
  if (parts.console.height > 0.0F) {
    begin_part("console", parts.console, corner.x, corner.y);
    monitor_.draw_console(attempt.monitor(), seen_, &told_);
    ImGui::EndChild();
  }
  begin_words("acts", parts.acts, corner.x, corner.y);
  if (running)
    acts_.draw(trainer, seen_, flipped(), room_.view_of_hands(seen_));
  else
    ImGui::TextUnformatted("Storing and grading the attempt …");
  // The rest gives way until every button is there; not back again, for it would leap with each answer.
  acts_px_ = std::max(acts_px_, ImGui::GetCursorPosY() + ImGui::GetStyle().WindowPadding.y);
  ImGui::EndChild();
  begin_words("hands", parts.hands, corner.x, corner.y);
  draw_hands(task);
  ImGui::EndChild();
  end_screen();
  draw_arms_live(attempt);

  if (!running) {
    if (!fired_) keep_picture();
    return;
  }
  read_keys(trainer, keys);
  attempt.tell(told_);  // what the guidance's console asks for
  if (keys.pressed(kF5)) {
    trainer.again();
    return;
  }
  if (leaving_) draw_pause(trainer);
}

}  // namespace seldinger::app
