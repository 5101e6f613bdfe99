// What the window answers to acts, in words.
#include "app/window/hands/act_words.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

using cases::EventKind;

TEST(ActWords, OfAFireTellHowFarTheTipWasThrown) {
  cases::Instrument core;
  core.kind = cases::InstrumentKind::core;
  core.throw_mm = 21.6;
  EXPECT_EQ(fire_words(core), "fired, 22 mm");
  EXPECT_EQ(fired_answer(core), "Fired: the tip was thrown 22 mm on.");
  EXPECT_EQ(fire_words(cases::Instrument{.kind = cases::InstrumentKind::access}), "“I am there” said");
}

TEST(ActWords, OfWhatIsSaidAreForEverythingThatATraineeSaysInTheRoom) {
  for (const cases::EventInfo& event : cases::event_kinds()) {
    if (event.source != cases::EventSource::trainee || event.kind == EventKind::sign_in ||
        event.kind == EventKind::sign_out || event.kind == EventKind::depth_measured)
      continue;
    EXPECT_FALSE(said_words({event.kind}).empty()) << event.name;
  }
  EXPECT_EQ(said_words({EventKind::note_plan, 61.4}), "Entry noted, with a planned needle depth of 61 mm.");
  EXPECT_NE(said_words({EventKind::note_plan}), said_words({EventKind::note_plan, 61.4}));
  EXPECT_NE(said_words({EventKind::probe_checked, 0.0, true}), said_words({EventKind::probe_checked, 0.0, false}));
}

TEST(ActWords, APlanWithoutADepthIsNotedOnlyWhereNoneCanBeSet) {
  EXPECT_TRUE(depth_is_missing(EventKind::note_plan, 0.0, cases::Modality::ultrasound));
  EXPECT_TRUE(depth_is_missing(EventKind::note_plan, 0.0, cases::Modality::mpr));
  EXPECT_FALSE(depth_is_missing(EventKind::note_plan, 61.0, cases::Modality::ultrasound));
  EXPECT_FALSE(depth_is_missing(EventKind::note_plan, 0.0, cases::Modality::xray)) << "its room has no slider";
  EXPECT_FALSE(depth_is_missing(EventKind::aspirate, 0.0, cases::Modality::ultrasound));
}

TEST(ActWords, OfAPhantomTellThatItIsNobodyAndHasNoSkin) {
  for (const EventKind both : {EventKind::probe_checked, EventKind::note_plan})
    EXPECT_TRUE(phantom_words(both).empty());
  EXPECT_NE(phantom_words(EventKind::nick).find("no skin"), std::string::npos);
  for (const EventKind kind : {EventKind::aspirate, EventKind::anaesthetic, EventKind::stylet_in,
                               EventKind::stylet_out, EventKind::inject, EventKind::breath_hold_request})
    EXPECT_FALSE(phantom_words(kind).empty());
}

TEST(ActWords, OfACoreNeedlesStyletAreOfItsIntroducer) {
  using haptics::Introducer;
  const auto words = [](EventKind kind, bool needle_in, Introducer before) {
    return said_words({.kind = kind, .needle_in = needle_in, .core = true, .introducer = before});
  };
  EXPECT_EQ(words(EventKind::stylet_in, false, Introducer::none),
            "You now hold the introducer with its stylet in. It is wider than the needle.");
  EXPECT_EQ(words(EventKind::stylet_in, true, Introducer::none),
            "The needle is in tissue: withdraw it before you take an introducer.");
  EXPECT_EQ(words(EventKind::stylet_out, true, Introducer::closed),
            "The stylet is out. The introducer stays in place, and the needle slides through it.");
  EXPECT_EQ(words(EventKind::stylet_in, true, Introducer::open),
            "The introducer’s stylet is back in: you now push the introducer.");
  EXPECT_EQ(words(EventKind::stylet_in, false, Introducer::open),
            "The introducer is out again, with its stylet in.");
  EXPECT_EQ(words(EventKind::stylet_out, false, Introducer::closed), "The introducer is put down.");
  EXPECT_EQ(said_words({EventKind::stylet_in}), "The stylet is back in.") << "of an access needle";
}

TEST(ActWords, OfTheArmsTellWhatStandsInTheWayFirst) {
  ArmsHeld arms{.used = true, .lost = {}, .tools = {haptics::Tool::probe, haptics::Tool::needle}};
  EXPECT_EQ(arms_words(arms).words, "left arm: probe · right arm: needle · F10: live");
  EXPECT_FALSE(arms_words(arms).warns);
  arms.at_limit[1] = true;
  EXPECT_EQ(arms_words(arms).words, "right arm at its limit: the tissue resists more than you feel");
  EXPECT_TRUE(arms_words(arms).warns);
  EXPECT_STREQ(arm_state(arms, haptics::Side::right), "at_limit");
  EXPECT_STREQ(arm_state(arms, haptics::Side::left), "ok");
  arms.at_limit[0] = true;
  EXPECT_EQ(arms_words(arms).words, "both arms at their limit: the tissue resists more than you feel");
  arms.late[0] = true;
  EXPECT_EQ(arms_words(arms).words, "the left arm answers too late to push back: little or no force there");
  arms.late[1] = true;
  EXPECT_EQ(arms_words(arms).words, "both arms answer too late to push back: little or no force there");
  arms.lost[1] = true;
  EXPECT_EQ(arms_words(arms).words,
            "right arm lost: the needle stays where it is; move it with mouse and keys (Tab)");
  EXPECT_STREQ(arm_state(arms, haptics::Side::right), "lost");
  EXPECT_STREQ(arm_state(arms, haptics::Side::left), "late");
}

TEST(ActWords, OfAnAnaestheticTellTheNewestPlace) {
  engine::Moment moment;
  moment.state.needle.skin.tip_lps_mm = {0.0, 0.0, 0.0};
  moment.numbed = 5;  // the fifth lies where the first did
  moment.numb_lps_mm = {glm::dvec3{0.0, 12.0, 0.0}, {0.0, 80.0, 0.0}, {0.0, 81.0, 0.0}, {0.0, 82.0, 0.0}};
  EXPECT_EQ(numb_words(moment), "Numb: skin and path, 15 mm about where the needle points (12 mm from its tip).");
  moment.state.needle.skin.in_body = true;
  EXPECT_EQ(numb_words(moment), "Numb: skin and path, 15 mm about where the needle went in.");
  moment.state.needle.inserted_mm = 31.6;
  EXPECT_EQ(deep_numb_words(moment), "Numb: 15 mm about the needle’s tip, which is 32 mm in.");
}

TEST(ActWords, OfWhatComesOutOfANeedleNameIt) {
  using cases::LumenContent;
  EXPECT_EQ(said_words({EventKind::aspirate}), "Aspirated: no blood comes.");
  EXPECT_EQ(said_words({EventKind::aspirate, 40.0, false, true}), "Aspirating through the needle …");
  cases::NeedleFlow flow;
  EXPECT_EQ(aspirated_words(flow), "Aspirated through the needle: no blood comes.");
  EXPECT_EQ(flow_words(flow), "");
  flow.aspirated = LumenContent::arterial_blood;
  EXPECT_EQ(aspirated_words(flow), "Aspirated through the needle: bright blood comes.");
  flow.stylet_out = true;
  EXPECT_EQ(flow_words(flow), "nothing comes out of the open needle");
  flow.column = flow.at_hub = LumenContent::urine;
  EXPECT_EQ(flow_words(flow), "urine drips from the open needle");
  flow.column = LumenContent::none;
  EXPECT_EQ(flow_words(flow), "nothing comes out of the open needle") << "its tip has left the lumen";
  flow.syringe_ml = 0.5;
  EXPECT_EQ(flow_words(flow), "contrast is running in");
}

TEST(ActWords, OfAGuideSayWhyThereIsNone) {
  using cases::Modality;
  Seen seen;
  EXPECT_NE(guide_words(seen, Modality::xray).find("ultrasound probe"), std::string::npos);
  const std::string off = guide_words(seen, Modality::ultrasound);
  seen.inserted = true;
  EXPECT_NE(guide_words(seen, Modality::ultrasound).find("withdraw it"), std::string::npos);
  seen.guided = true;
  const std::string on = guide_words(seen, Modality::ultrasound);
  seen.in_guide = true;
  const std::string in = guide_words(seen, Modality::ultrasound);
  EXPECT_NE(in.find("dotted lines"), std::string::npos);
  EXPECT_TRUE(on != off && on != in && in != off);
  seen.needle_by_mouse = false;
  EXPECT_NE(guide_words(seen, Modality::ultrasound).find("an arm"), std::string::npos);
}

TEST(ActWords, OfWhatIsInTheHandNameNoProbeWhereThereIsNone) {
  Seen seen;
  EXPECT_EQ(in_hand_words(seen, cases::Modality::ultrasound), "In the hand: needle (Tab)");
  EXPECT_EQ(in_hand_words(seen, cases::Modality::xray), "In the hand: needle");
  seen.moment.state.fluoroscopy.hand_away = true;
  EXPECT_EQ(in_hand_words(seen, cases::Modality::xray), "Your hand is away (H)");
  seen = {};
  seen.held = devices::HeldTool::probe;
  EXPECT_EQ(in_hand_words(seen, cases::Modality::ultrasound), "In the hand: probe (Tab)");
}

TEST(ActWords, OfTheBreathFollowThePatient) {
  cases::PatientBreath breath;
  EXPECT_EQ(breath_words(breath), "");
  breath.hold_asked = true;
  EXPECT_EQ(breath_words(breath), "the breath is not held yet");
  breath.state.held = 1.0;
  EXPECT_EQ(breath_words(breath), "the breath is held");
  breath.state.failed = true;
  EXPECT_EQ(breath_words(breath), "the breath could not be held any longer");
}

}  // namespace
}  // namespace seldinger::app
