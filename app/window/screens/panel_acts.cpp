#include "app/window/screens/panel_acts.h"

#include <imgui.h>

#include <array>
#include <cmath>

#include "app/window/hands/act_words.h"
#include "app/window/hands/coach.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"

namespace seldinger::app {
namespace {

using cases::EventKind;

// What can be said, in the order in which it is: a button each, and a key.
struct Saying {
  int key;
  const char* label;
  EventKind kind;
};
constexpr std::array<Saying, 10> kSayings = {{
    {kF1, "F1  Probe checked", EventKind::probe_checked},
    {kF1 + 1, "F2  Entry and depth noted", EventKind::note_plan},
    {kF1 + 2, "F3  Aspirate", EventKind::aspirate},
    {kF1 + 3, "F4  Anaesthetic", EventKind::anaesthetic},
    {'/', "/  Stylet out, in", EventKind::stylet_out},
    {'\\', "\\  Inject contrast", EventKind::inject},
    {kF1 + 5, "F6  Nick the skin", EventKind::nick},
    {'/', "/  Introducer", EventKind::stylet_in},
    {kF1 + 6, "F7  Hold your breath", EventKind::breath_hold_request},
    {kF1 + 7, "F8  Breathe again", EventKind::breathe_again},
}};

bool asked_for(const Saying& saying, const cases::Case& scene) {
  if (saying.kind == EventKind::probe_checked) return scene.picture.modality == cases::Modality::ultrasound;
  if (scene.subject == cases::Subject::phantom && !phantom_words(saying.kind).empty()) return false;
  if (saying.kind == EventKind::stylet_out || saying.kind == EventKind::inject)
    return scene.instrument.kind == cases::InstrumentKind::access;
  if (saying.kind == EventKind::nick || saying.kind == EventKind::stylet_in)
    return scene.instrument.kind == cases::InstrumentKind::core;
  return true;
}

constexpr float kPlannedPx = 190.0F;  // wide: the slider of the planned depth

// With a tick once it is done, and how often where that is more than once; an introducer's by what comes next.
std::string done_label(const Saying& saying, int times, haptics::Introducer introducer) {
  if (saying.kind == EventKind::stylet_in && introducer != haptics::Introducer::none)
    return introducer == haptics::Introducer::closed ? "/  Stylet out" : "/  Stylet in";
  if (times == 0) return saying.label;
  return "✓ " + std::string(saying.label) + (times > 1 ? " (" + std::to_string(times) + "×)" : "");
}

}  // namespace

void ActsPanel::begin(const PersonAttempt& attempt, const std::optional<assessment::PlannedPath>& plan) {
  done_.clear();
  for (const EventKind kind : attempt.said_before()) ++done_[kind];
  decided_ = attempt.task()->scene.subject == cases::Subject::phantom  // nobody is asked
             || done_.contains(EventKind::proceed) || done_.contains(EventKind::defer);
  numbed_ = deep_ = guides_asked_ = 0;
  in_guide_ = fired_ = false;
  happened_s_ = 0.0;
  aspirated_s_ = 0.0;
  answered_.clear();
  answer_.clear();
  planned_mm_ = plan ? std::round(plan->depth_mm()) : 0.0;
}

void ActsPanel::answer(const Seen& seen, const std::string& words) {
  const int whole_s = static_cast<int>(seen.moment.state.t_s);
  char when[16];
  std::snprintf(when, sizeof when, "%d:%02d  ", whole_s / 60, whole_s % 60);
  answered_ = when;
  answer_ = words;
}

void ActsPanel::say(PersonAttempt& attempt, const Seen& seen, bool flipped, EventKind kind) {
  const cases::NeedleState& needle = seen.moment.state.needle;
  const bool core = attempt.task()->scene.instrument.kind == cases::InstrumentKind::core;
  const haptics::Introducer introducer = seen.moment.introducer;
  if (kind == EventKind::stylet_out && seen.moment.state.flow.stylet_out)
    kind = EventKind::stylet_in;
  else if (core && kind == EventKind::stylet_in && introducer == haptics::Introducer::closed)
    kind = EventKind::stylet_out;
  double length_mm = 0.0;
  if (kind == EventKind::note_plan) length_mm = planned_mm_;
  if (depth_is_missing(kind, length_mm, attempt.task()->scene.picture.modality))
    return answer(seen, missing_depth_words());
  if ((kind == EventKind::anaesthetic || kind == EventKind::aspirate) && needle.skin.in_body)
    length_mm = needle.inserted_mm;
  // None is taken up in tissue: the words say so, and nothing is done.
  const bool refused =
      core && kind == EventKind::stylet_in && needle.skin.in_body && introducer == haptics::Introducer::none;
  if (!refused && !attempt.say(kind, length_mm)) return answer(seen, "Too much at once: do it again.");
  if (!refused) ++done_[kind];
  std::string words = said_words({kind, length_mm, flipped, needle.skin.in_body, core, introducer});
  if (words.empty())
    if (const cases::EventInfo* info = cases::find_event(kind)) words = info->words;  // a mentor's
  answer(seen, words);
}

void ActsPanel::finish(PersonAttempt& attempt, const Seen& seen, bool flipped) {
  if (attempt.task()->scene.subject == cases::Subject::patient) say(attempt, seen, flipped, EventKind::sign_out);
  attempt.end();
}

// What an anaesthetic did is told once it has, with its place.
void ActsPanel::look(const Seen& seen, const cases::Case& scene) {
  if (seen.moment.state.fire.fired && !fired_) {
    fired_ = true;
    answer(seen, fired_answer(scene.instrument));
  }
  if (seen.moment.numbed > numbed_) {
    numbed_ = seen.moment.numbed;
    answer(seen, numb_words(seen.moment));
  }
  if (seen.moment.deep > deep_) {
    deep_ = seen.moment.deep;
    answer(seen, deep_numb_words(seen.moment));
  }
  const cases::EventInfo* event = cases::find_event(seen.moment.event);
  if (event != nullptr && event->source == cases::EventSource::mentor && seen.moment.event_t_s > happened_s_) {
    happened_s_ = seen.moment.event_t_s;
    answer(seen, event->words);
  }
  const engine::Moment& moment = seen.moment;
  if (moment.event == EventKind::aspirate && moment.event_t_s > aspirated_s_ && moment.state.needle.skin.in_body) {
    aspirated_s_ = moment.event_t_s;
    answer(seen, aspirated_words(moment.state.flow));
  }
  if (seen.guides_asked != guides_asked_ || (seen.in_guide && !in_guide_))
    answer(seen, guide_words(seen, scene.picture.modality));
  guides_asked_ = seen.guides_asked;
  in_guide_ = seen.in_guide;
}

void ActsPanel::note_measured(PersonAttempt& attempt, const Seen& seen, double depth_mm) {
  if (!attempt.say(EventKind::depth_measured, depth_mm)) return;
  planned_mm_ = std::round(depth_mm);
  answer(seen, "Measured: " + std::to_string(std::lround(depth_mm)) + " mm deep; F2 notes it as the plan.");
}

void ActsPanel::read_keys(PersonAttempt& attempt, const Seen& seen, bool flipped, const Keys& keys) {
  look(seen, attempt.task()->scene);
  if (!decided_ && keys.pressed('Y')) {
    decided_ = true;
    say(attempt, seen, flipped, EventKind::proceed);
  } else if (!decided_ && keys.pressed('N')) {
    decided_ = true;
    say(attempt, seen, flipped, EventKind::defer);
    finish(attempt, seen, flipped);
  }
  for (const Saying& saying : kSayings) {
    if (!keys.pressed(saying.key)) continue;
    const cases::Case& scene = attempt.task()->scene;
    if (!asked_for(saying, scene)) {
      const std::string words = phantom_words(saying.kind);
      if (scene.subject == cases::Subject::phantom && !words.empty()) answer(seen, words);
      continue;
    }
    if (decided_)
      say(attempt, seen, flipped, saying.kind);
    else
      answer(seen, "First decide: proceed (Y) or defer (N).");
  }
  if (keys.pressed(kSpace) && seen.moment.state.fluoroscopy.hand_away)
    answer(seen, in_hand_words(seen, attempt.task()->scene.picture.modality) + ".");
  if (keys.pressed(kF9)) finish(attempt, seen, flipped);
}

void ActsPanel::draw_planned_depth(const cases::Case& scene) {
  auto planned_mm = static_cast<float>(planned_mm_);
  ImGui::SetNextItemWidth(scaled(kPlannedPx));
  if (ImGui::SliderFloat("##planned", &planned_mm, 0.0F, static_cast<float>(scene.instrument.length_mm),
                         planned_mm_ > 0.0 ? "planned depth %.0f mm" : "planned depth: not set",
                         ImGuiSliderFlags_AlwaysClamp))
    planned_mm_ = std::round(static_cast<double>(planned_mm));
  note_item("planned depth");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip(
        "how far you plan to insert the needle, by its marks; F2 notes it (measuring from skin to target with the "
        "calipers sets it)");
}

void ActsPanel::draw_decision(PersonAttempt& attempt, const Seen& seen, bool flipped) {
  ImGui::TextWrapped("The sign-in is complete. Proceed with this puncture, or defer it?");
  if (noted_button("Proceed (Y)")) {
    decided_ = true;
    say(attempt, seen, flipped, EventKind::proceed);
  }
  ImGui::SameLine();
  if (noted_button("Defer (N)")) {
    decided_ = true;
    say(attempt, seen, flipped, EventKind::defer);
    finish(attempt, seen, flipped);
  }
}

// Above the buttons, where it stays in sight however many rows they take.
void ActsPanel::draw_answer(const Seen& seen) {
  const std::string breath = breath_words(seen.moment.state.breath);
  const std::string flow = flow_words(seen.moment.state.flow);
  const std::string words =
      answer_ + (breath.empty() ? "" : "  Now " + breath + ".") + (flow.empty() ? "" : "  Now " + flow + ".");
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.62F, 0.86F, 0.97F, 1.0F));
  ImGui::TextWrapped("%s%s", answered_.c_str(), words.empty() ? " " : words.c_str());
  ImGui::PopStyleColor();
  if (!words.empty()) note_item(words.c_str());
}

void ActsPanel::draw_hint(const std::string& words) {
  if (words.empty()) return;
  ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0.98F, 0.84F, 0.50F, 1.0F));
  ImGui::TextWrapped("Hint: %s", words.c_str());
  ImGui::PopStyleColor();
  note_item(("Hint: " + words).c_str());
}

void ActsPanel::draw(Trainer& trainer, const Seen& seen, bool flipped, const devices::HandView& view) {
  PersonAttempt& attempt = *trainer.attempt();
  const cases::Case& scene = attempt.task()->scene;
  draw_hint(hint_words(scene, seen, trainer.help(), view));
  draw_answer(seen);
  if (!decided_) return draw_decision(attempt, seen, flipped);
  const float room = ImGui::GetContentRegionAvail().x;
  float used = 0.0F;
  for (const Saying& saying : kSayings) {
    if (!asked_for(saying, scene)) continue;
    const bool plan = saying.kind == EventKind::note_plan && scene.picture.modality != cases::Modality::xray;
    const auto done = done_.find(saying.kind);
    const std::string label = done_label(saying, done == done_.end() ? 0 : done->second, seen.moment.introducer);
    const float own = ImGui::CalcTextSize(label.c_str()).x + scaled(24.0F);
    float wide = own + (plan ? scaled(kPlannedPx + 8.0F) : 0.0F);
    if (used > 0.0F && used + wide < room) ImGui::SameLine();
    if (used + wide >= room) used = 0.0F;
    used += wide;
    if (plan) {
      draw_planned_depth(scene);
      if (wide < room)
        ImGui::SameLine();
      else
        used = own;
    }
    if (noted_button((label + "##" + saying.label).c_str())) say(attempt, seen, flipped, saying.kind);
  }
  const bool patient = scene.subject == cases::Subject::patient;
  const char* end = patient ? "F9  Sign out and finish" : "F9  Finish";
  if (used + ImGui::CalcTextSize(end).x + scaled(24.0F) < room) ImGui::SameLine();
  if (noted_button(end)) finish(attempt, seen, flipped);
  if (!patient || !trainer.may(casedb::Action::cause_event)) return;
  used = 0.0F;
  for (const cases::EventInfo& event : cases::event_kinds()) {
    if (event.source != cases::EventSource::mentor) continue;
    const float wide = ImGui::CalcTextSize(event.words).x + scaled(24.0F);
    if (used > 0.0F && used + wide < room) ImGui::SameLine();
    used = used + wide < room ? used + wide : wide;
    if (ImGui::Button(event.words)) say(attempt, seen, flipped, event.kind);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("triggered by a mentor: %s", event.about);
  }
}

}  // namespace seldinger::app
