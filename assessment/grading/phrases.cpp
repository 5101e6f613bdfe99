#include "assessment/grading/phrases.h"

#include <algorithm>

#include "assessment/grading/plain_words.h"

namespace seldinger::assessment {
namespace {

constexpr Phrase kPhrases[] = {
    {"hit", "target", "Hit the target", "Hit the target", "Missed the target"},
    {"first_pass_success", "target", "Hit the target on the first pass", "Hit the target on the first pass",
     "Did not hit the target on the first pass"},
    {"core_in_target", "target", "Only {} of the sample notch lay in the target",
     "{} of the sample notch lay in the target", "No part of the sample notch lay in the target"},
    {"tip_target_dist", "target", "Ended {} from the target's centre", "Ended only {} from the target's centre"},
    {"tip_target_surface", "target", "Ended {} outside the target", "Ended only {} outside the target",
     "Ended on the target's surface", "Ended {} inside the target's surface"},
    {"tip_target_axial", "target", "Stopped {} short of the target's centre",
     "Stopped only {} short of the target's centre", "Stopped level with the target's centre",
     "Went {} beyond the target's centre"},
    {"tip_target_lateral", "target", "Ended {} beside the target's centre",
     "Ended only {} beside the target's centre", "Aimed straight at the target's centre"},
    {"closest_approach", "target", "Came no nearer than {} to the target's centre",
     "Came as near as {} to the target's centre"},
    {"entry_angle_error", "entry", "Entered {} off the planned direction",
     "Entered only {} off the planned direction"},
    {"entry_point_error", "entry", "Went in {} from the planned entry", "Went in only {} from the planned entry"},
    {"skin_punctures", "punctures", "Punctured the skin {times}", "Punctured the skin only {times}",
     "Did not puncture the skin"},
    {"withdrawals_partial", "withdrawals", "Pulled the needle back and aimed again {times}",
     "Pulled the needle back and aimed again only {times}", "Never had to pull the needle back"},
    {"withdrawals_full", "punctures", "Took the needle out and began again {times}",
     "Took the needle out and began again only {times}", "Never had to take the needle out and begin again"},
    {"nogo_contacts", "no-go", "Touched structures to stay out of {times}",
     "Touched structures to stay out of only {times}", "Kept out of every structure to stay out of"},
    {"clearance_min", "no-go", "Passed only {} from a structure to stay out of",
     "Kept {} away from every structure to stay out of", "Grazed a structure to stay out of",
     "Went {} deep into a structure to stay out of"},
    {"capsule_punctures", "capsule", "Went through the organ's capsule {times}",
     "Went through the organ's capsule only {times}", "Did not go through the organ's capsule"},
    {"posterior_wall", "wall", "Went through the far wall {times}", "Went through the far wall only {times}",
     "Stayed short of the far wall"},
    {"back_wall_dist", "wall", "Ended only {} before the far wall", "Ended {} before the far wall",
     "Ended at the far wall"},
    {"must_cross_length", "must-cross", "Crossed only {} of the tissue that the way should lead through",
     "Crossed {} of the tissue that the way should lead through",
     "Did not cross the tissue that the way should lead through"},
    {"nogo_length", "no-go", "Went {} through structures to stay out of",
     "Went only {} through structures to stay out of", "Kept out of every structure to stay out of"},
    {"nogo_length_critical", "no-go", "Went {} through a structure that must never be touched",
     "Went only {} through a structure that must never be touched",
     "Kept out of every structure that must never be touched"},
    {"nogo_length_major", "no-go", "Went {} through a structure whose injury is a complication",
     "Went only {} through a structure whose injury is a complication",
     "Kept out of every structure whose injury is a complication"},
    {"nogo_length_advisory", "no-go", "Went {} through a structure that is better avoided",
     "Went only {} through a structure that is better avoided",
     "Kept out of every structure that is better avoided"},
    {"nogo_time", "no-go", "Was inside structures to stay out of for {}",
     "Was inside structures to stay out of for only {}", "Kept out of every structure to stay out of"},
    {"decision_right", "decision", "Decided rightly whether to go ahead", "Decided rightly whether to go ahead",
     "Decided wrongly whether to go ahead"},
    {"steps_done", "steps", "Did only {} of the steps that were asked for",
     "Did {} of the steps that were asked for", "Did none of the steps that were asked for"},
    {"steps_shown", "steps", "Showed only {} of the steps that a deed can show",
     "Showed {} of the steps that a deed can show", "Showed none of the steps that a deed can show"},
    {"steps_violated", "steps violated", "Violated a step of the procedure {times}",
     "Violated a step of the procedure only {times}", "Violated no step of the procedure"},
    {"pain_reactions", "pain", "Hurt the patient {times}", "Hurt the patient only {times}",
     "Did not hurt the patient"},
    {"advance_breath_held_share", "breath", "Advanced on the last of the way only {} with the breath held",
     "Advanced on the last of the way {} with the breath held", "Advanced on the last of the way in moving breath"},
    {"advance_in_breath", "breath", "Advanced {} on the last of the way while breath moved",
     "Advanced only {} on the last of the way while breath moved",
     "Never advanced on the last of the way while breath moved"},
    {"fired_breath_held", "breath", "Fired with the breath held", "Fired with the breath held",
     "Fired while breath moved"},
    {"breath_hold_time", "breath time", "Had the breath held for {}", "Had the breath held for only {}",
     "Never had the breath held"},
    {"breath_hold_used", "breath time", "Used only {} of the time for which the breath was held",
     "Used {} of the time for which the breath was held", "Used nothing of the time for which the breath was held"},
    {"breath_holds_asked", "breath times", "Asked for a held breath {times}", "Asked for a held breath {times}",
     "Never asked for a held breath"},
    {"breath_holds_failed", "breath times", "Lost a held breath {times}", "Lost a held breath only {times}",
     "Never lost a held breath"},
    {"force_peak_axial", "force", "Pushed with up to {} along the needle",
     "Pushed with no more than {} along the needle", "Did not push along the needle"},
    {"lateral_force_peak", "force", "Bent the needle with up to {}", "Bent the needle with no more than {}",
     "Did not bend the needle"},
    {"advance_visible_share", "unseen advance", "Had the tip in the picture for only {} of the advance",
     "Had the tip in the picture for {} of the advance", "Never had the tip in the picture while advancing"},
    {"blind_advance", "unseen advance", "Advanced {} with the tip out of the picture",
     "Advanced only {} with the tip out of the picture", "Never advanced with the tip out of the picture"},
    {"blind_advance_max", "unseen advance", "Advanced {} in one go with the tip out of the picture",
     "Advanced at most {} in one go with the tip out of the picture",
     "Never advanced with the tip out of the picture"},
    {"plane_angle_mean", "plane", "Held the needle {} off the picture's plane on average",
     "Held the needle only {} off the picture's plane on average", "Held the needle in the picture's plane"},
    {"plane_angle_max", "plane", "Held the needle up to {} off the picture's plane",
     "Held the needle at most {} off the picture's plane", "Held the needle in the picture's plane"},
    {"advance_beyond_plane", "unseen advance", "Advanced {} beyond the picture's plane",
     "Advanced only {} beyond the picture's plane", "Never advanced beyond the picture's plane"},
    {"probe_drift_advancing", "probe", "Let the probe drift {} while advancing",
     "Let the probe drift only {} while advancing", "Held the probe still while advancing"},
    {"vis_joint", "seen", "Had tip and target in one picture for only {} of the time in tissue",
     "Had tip and target in one picture for {} of the time in tissue",
     "Never had tip and target in one picture in tissue"},
    {"vis_needle", "seen", "Had the tip in the picture for only {} of the time in tissue",
     "Had the tip in the picture for {} of the time in tissue", "Never had the tip in the picture in tissue"},
    {"vis_shaft", "seen", "Had any of the needle in the picture for only {} of the time in tissue",
     "Had the needle in the picture for {} of the time in tissue", "Never had the needle in the picture in tissue"},
    {"vis_target", "seen target", "Had the target in the picture for only {} of the time in tissue",
     "Had the target in the picture for {} of the time in tissue",
     "Never had the target in the picture while in tissue"},
    {"vis_joint_session", "seen", "Had tip and target in one picture for only {} of the whole time",
     "Had tip and target in one picture for {} of the whole time", "Never had tip and target in one picture"},
    {"vis_joint_2_mm", "seen", "Had tip and target within 2 mm of the picture's plane for only {} of the time",
     "Had tip and target within 2 mm of the picture's plane for {} of the time",
     "Never had tip and target within 2 mm of the picture's plane"},
    {"vis_joint_5_mm", "seen", "Had tip and target within 5 mm of the picture's plane for only {} of the time",
     "Had tip and target within 5 mm of the picture's plane for {} of the time",
     "Never had tip and target within 5 mm of the picture's plane"},
    {"visible_needle_length", "seen", "Had only {} of the shaft in the picture on average",
     "Had {} of the shaft in the picture on average", "Never had the shaft in the picture"},
    {"path_tip", "path", "Moved the tip {} in all", "Moved the tip only {} in all"},
    {"path_in_tissue", "path", "Moved the tip {} inside the body", "Moved the tip only {} inside the body",
     "Did not move the tip inside the body"},
    {"path_inefficiency", "path", "Went {} further in tissue than the straight way",
     "Went only {} further in tissue than the straight way", "Went the straight way in tissue"},
    {"swept_area", "path", "Swept {} of tissue with the shaft", "Swept only {} of tissue with the shaft",
     "Swept no tissue with the shaft"},
    {"ldlj", "smoothness", "Moved with a smoothness of {}, where nearer to 0 is smoother",
     "Moved with a smoothness of {}, where nearer to 0 is smoother"},
    {"time_total", "time", "Took {}", "Took only {}"},
    {"time_in_tissue", "time", "Had the needle in tissue for {}", "Had the needle in tissue for only {}",
     "Never had the needle in tissue"},
    {"time_puncture_to_target", "time", "Took {} from the puncture to the trigger",
     "Took only {} from the puncture to the trigger"},
    {"fluoroscopy_time", "beam", "Had the beam on for {}", "Had the beam on for only {}", "Used no beam"},
    {"pulses", "beam", "Fired {} X-ray pulses", "Fired only {} X-ray pulses", "Fired no X-ray pulse"},
    {"pulse_rate_max", "pulse rate", "Fired as many as {} X-ray pulses", "Fired no more than {} X-ray pulses"},
    {"dap", "dose", "Spent a dose–area product of {}", "Spent a dose–area product of only {}", "Spent no dose"},
    {"air_kerma", "dose", "Spent an air kerma of {}", "Spent an air kerma of only {}", "Spent no dose"},
    {"beam_while_moving", "beam while moving", "Had the beam on for {} while the arm moved",
     "Had the beam on for only {} while the arm moved", "Never had the beam on while the arm moved"},
    {"collimated_share", "collimator", "Shut off only {} of the field with the collimator",
     "Shut off {} of the field with the collimator", "Left the collimator open"},
    {"views", "views", "Looked from directions to the number of {}", "Looked from directions to the number of {}",
     "Looked from no direction with the arm at rest"},
    {"view_angle_max", "views", "Looked from directions only {} apart", "Looked from directions {} apart",
     "Looked from one direction only"},
    {"hand_in_beam", "hand", "Had the hand in the beam for {}", "Had the hand in the beam for only {}",
     "Kept the hand out of the beam"},
    {"longest_advance_between_exposures", "unseen advance", "Advanced {} without a picture",
     "Advanced at most {} without a picture", "Never advanced without a picture"},
    {"gap_share", "tracking", "Tracking was lost for {} of the time", "Tracking was lost for only {} of the time",
     "Tracking was never lost"},
    {"sample_rate_p5", "tracking", "Tracking was as slow as {}", "Tracking kept {}"},
    {"tracking_jumps", "tracking", "Tracking jumped {times}", "Tracking jumped only {times}",
     "Tracking never jumped"},
};

void replace(std::string& text, std::string_view hole, std::string_view value) {
  if (const std::size_t at = text.find(hole); at != text.npos) text.replace(at, hole.size(), value);
}

}  // namespace

std::span<const Phrase> phrases() {
  return kPhrases;
}

const Phrase* find_phrase(std::string_view id) noexcept {
  const auto found =
      std::find_if(std::begin(kPhrases), std::end(kPhrases), [&](const Phrase& one) { return one.id == id; });
  return found == std::end(kPhrases) ? nullptr : found;
}

std::string said(const Phrase& phrase, double value, std::string_view value_text, bool good) {
  std::string text(value == 0.0 && !phrase.zero.empty()      ? phrase.zero
                   : value < 0.0 && !phrase.negative.empty() ? phrase.negative
                   : good                                    ? phrase.good
                                                             : phrase.bad);
  replace(text, "{times}", plain_times(value));
  replace(text, "{}", value_text);
  return text;
}

}  // namespace seldinger::assessment
