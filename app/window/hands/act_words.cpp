#include "app/window/hands/act_words.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/engine/needle_flow.h"
#include "sim/tissue/breathing.h"

namespace seldinger::app {
namespace {

std::string whole_ml(double ml) {
  return std::to_string(std::lround(ml)) + " ml";
}

const char* content_words(cases::LumenContent content) {
  constexpr const char* kWords[] = {"nothing", "urine", "bile", "dark blood", "bright blood", "fluid"};
  return kWords[static_cast<std::size_t>(content)];
}

std::string whole_mm(double mm) {
  return std::to_string(std::lround(mm)) + " mm";
}

}  // namespace

std::string in_hand_words(const Seen& seen, cases::Modality modality) {
  if (modality == cases::Modality::xray)
    return seen.moment.state.fluoroscopy.hand_away ? "Your hand is away (H)" : "In the hand: needle";
  return std::string("In the hand: ") + (seen.held == devices::HeldTool::needle ? "needle" : "probe") +
         (seen.guided ? ", in the guide (Tab)" : " (Tab)");
}

std::string fire_words(const cases::Instrument& instrument) {
  if (instrument.kind != cases::InstrumentKind::core) return "“I am there” said";
  return "fired, " + whole_mm(instrument.throw_mm);
}

std::string fired_answer(const cases::Instrument& instrument) {
  if (instrument.kind != cases::InstrumentKind::core)
    return "Said: “I am there”. The tip’s present position counts.";
  return "Fired: the tip was thrown " + whole_mm(instrument.throw_mm) + " on.";
}

std::string said_words(const Said& said) {
  using cases::EventKind;
  switch (said.kind) {
    case EventKind::proceed:
      return "Decided: the puncture goes ahead.";
    case EventKind::defer:
      return "Decided: the puncture is deferred.";
    case EventKind::probe_checked:
      return std::string("Probe checked: its marker’s side is the picture’s ") +
             (said.flipped ? "right." : "left.");
    case EventKind::note_plan:
      return said.planned_mm > 0.0
                 ? "Entry noted, with a planned needle depth of " + whole_mm(said.planned_mm) + "."
                 : "Entry noted; the needle’s depth is not set.";
    case EventKind::aspirate:
      return said.needle_in ? "Aspirating through the needle …" : "Aspirated: no blood comes.";
    case EventKind::anaesthetic:
      return "Giving local anaesthetic …";
    case EventKind::nick:
      return "Skin nicked where the needle points.";
    case EventKind::stylet_out:
      if (said.core)
        return said.needle_in
                   ? "The stylet is out. The introducer stays in place, and the needle slides through it."
                   : "The introducer is put down.";
      return "The stylet is out: watch what comes back.";
    case EventKind::stylet_in:
      if (said.core && said.needle_in)
        return said.introducer == haptics::Introducer::none
                   ? "The needle is in tissue: withdraw it before you take an introducer."
                   : "The introducer’s stylet is back in: you now push the introducer.";
      if (said.core)
        return said.introducer == haptics::Introducer::none
                   ? "You now hold the introducer with its stylet in. It is wider than the needle."
                   : "The introducer is out again, with its stylet in.";
      return "The stylet is back in.";
    case EventKind::inject:
      return said.needle_in ? "Injecting contrast: " + whole_ml(engine::kPushMl) + "."
                            : "The needle is outside the body: the contrast drips away.";
    case EventKind::breath_hold_request:
      return "Asked to hold the breath.";
    case EventKind::breathe_again:
      return "The patient may breathe again.";
    default:
      return {};
  }
}

std::string phantom_words(cases::EventKind kind) {
  using cases::EventKind;
  if (kind == EventKind::probe_checked || kind == EventKind::note_plan) return {};
  return kind == EventKind::nick ? "A phantom has no skin to nick: the needle goes in as it is."
                                 : "That is for a patient; a phantom needs none of it.";
}

bool depth_is_missing(cases::EventKind kind, double planned_mm, cases::Modality modality) {
  return kind == cases::EventKind::note_plan && !(planned_mm > 0.0) && modality != cases::Modality::xray;
}

std::string missing_depth_words() {
  return "Not noted: no depth is set. Set the needle’s depth, then press F2.";
}

std::string numb_words(const engine::Moment& moment) {
  CHECK(moment.numbed > 0);
  const cases::SkinPassage& skin = moment.state.needle.skin;
  const glm::dvec3& place_lps_mm = moment.numb_lps_mm[(moment.numbed - 1) % moment.numb_lps_mm.size()];
  const std::string where =
      skin.in_body
          ? "where the needle went in"
          : "where the needle points (" + whole_mm(glm::distance(place_lps_mm, skin.tip_lps_mm)) + " from its tip)";
  return "Numb: skin and path, " + whole_mm(engine::kNumbMm) + " about " + where + ".";
}

std::string deep_numb_words(const engine::Moment& moment) {
  return "Numb: " + whole_mm(engine::kNumbMm) + " about the needle’s tip, which is " +
         whole_mm(moment.state.needle.inserted_mm) + " in.";
}

std::string aspirated_words(const cases::NeedleFlow& flow) {
  if (flow.aspirated == cases::LumenContent::none) return "Aspirated through the needle: no blood comes.";
  return std::string("Aspirated through the needle: ") + content_words(flow.aspirated) + " comes.";
}

std::string flow_words(const cases::NeedleFlow& flow) {
  if (!flow.stylet_out) return {};
  if (flow.syringe_ml > 0.0) return "contrast is running in";
  const bool runs = flow.column != cases::LumenContent::none && flow.column == flow.at_hub;
  if (!runs) return "nothing comes out of the open needle";
  return std::string(content_words(flow.at_hub)) +
         (flow.at_hub == cases::LumenContent::arterial_blood ? " spurts" : " drips") + " from the open needle";
}

std::string guide_words(const Seen& seen, cases::Modality modality) {
  if (modality == cases::Modality::xray) return "No needle guide here: it is mounted on an ultrasound probe.";
  if (!seen.needle_by_mouse) return "No needle guide: an arm holds the needle and moves it freely.";
  if (seen.in_guide) return "The needle is in its guide: its path lies between the dotted lines in the picture.";
  if (seen.guided) return "Needle guide on: the needle moves to it; G puts it aside.";
  if (seen.inserted) return "The needle is free. It is in tissue: withdraw it before G brings it to its guide.";
  return "Needle guide off: the needle is free.";
}

ArmsSaid arms_words(const ArmsHeld& arms) {
  const auto tool = [&](std::size_t side) {
    return std::string(arms.tools[side] == haptics::Tool::needle ? "needle" : "probe");
  };
  const auto which = [](const std::array<bool, 2>& so) { return so[0] && so[1] ? 2 : so[0] ? 0 : so[1] ? 1 : -1; };
  constexpr const char* kArms[] = {"left arm", "right arm", "both arms"};
  if (const int lost = which(arms.lost); lost == 2)
    return {"both arms lost: their tools stay where they are; move them with mouse and keys (Tab)", true};
  else if (lost >= 0)
    return {std::string(kArms[lost]) + " lost: the " + tool(static_cast<std::size_t>(lost)) +
                " stays where it is; move it with mouse and keys (Tab)",
            true};
  if (const int late = which(arms.late); late >= 0)
    return {std::string(late == 2 ? "" : "the ") + kArms[late] + (late == 2 ? " answer" : " answers") +
                " too late to push back: little or no force there",
            true};
  if (const int limit = which(arms.at_limit); limit >= 0)
    return {std::string(kArms[limit]) + (limit == 2 ? " at their" : " at its") +
                " limit: the tissue resists more than you feel",
            true};
  return {"left arm: " + tool(0) + " · right arm: " + tool(1) + " · F10: live", false};
}

const char* arm_state(const ArmsHeld& arms, haptics::Side side) {
  const auto at = static_cast<std::size_t>(side);
  return arms.lost[at] ? "lost" : arms.late[at] ? "late" : arms.at_limit[at] ? "at_limit" : "ok";
}

std::string breath_words(const cases::PatientBreath& breath) {
  if (!breath.hold_asked) return {};
  if (breath.state.failed) return "the breath could not be held any longer";
  return tissue::holds(breath.state) ? "the breath is held" : "the breath is not held yet";
}

}  // namespace seldinger::app
