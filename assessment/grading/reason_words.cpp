#include "assessment/grading/reason_words.h"

#include <algorithm>

#include "assessment/grading/plain_words.h"

namespace seldinger::assessment {
namespace {

constexpr ReasonWords kReasons[] = {
    // How the attempt was made (needs.cpp).
    {"not_xray", "the guidance is not fluoroscopy"},
    {"not_ultrasound", "the guidance is not ultrasound"},
    {"not_meaningful_under_xray", "the guidance is fluoroscopy, whose picture has no plane"},
    {"not_meaningful_out_of_plane", "the approach is out of plane"},
    {"not_meaningful_in_plane", "the approach is in plane"},
    {"not_a_core_needle", "the needle is not a core needle"},
    // What the case or the desk does not have (needs.cpp).
    {"no_target", "the case has no target"},
    {"no_plan", "the case has no planned entry"},
    {"no_device", "no forces were recorded"},
    {"no_arm", "no force-feedback arm led the needle"},
    {"no_nogo_structure", "the case has no structure to stay out of"},
    {"no_critical_structure", "the case has no critical structure"},
    {"no_major_structure", "the case has no major structure"},
    {"no_advisory_structure", "the case has no advisory structure"},
    {"no_must_cross_structure", "the case has no structure that must be crossed"},
    {"no_organ_structure", "the target’s organ is not marked in this case"},
    {"no_target_structure", "no lumen to be reached is marked in this case"},
    {"no_patient", "a phantom is on the table, not a patient"},
    {"patient_lies_still", "the patient does not breathe in this case"},
    {"tissue_lies_still", "the tissue does not give way in this case"},
    {"no_skin", "the case has no skin surface"},
    {"no_right_decision", "the case does not say whether to go ahead or to defer"},
    // What the recording does not hold (needs.cpp).
    {"no_endpoint", "the needle was neither fired nor declared to be on target"},
    {"no_picture", "no picture was recorded"},
    {"beam_not_recorded", "the recording does not say what the beam did"},
    {"near_plane_not_recorded", "the recording does not say what lay near the picture’s plane"},
    {"calipers_not_recorded", "the recording does not say what the calipers measured"},
    {"field_not_known", "the X-ray field of a pulse is not known"},
    {"events_not_recorded", "the recording does not say what was said and done"},
    {"only_gaps", "tracking was lost throughout"},
    {"never_in_tissue", "the tip was never in tissue"},
    {"probe_given", "the case prescribes the probe"},
    {"no_such_event", "nothing went wrong that called for a response"},
    // What was done, or left undone (the metrics' own).
    {"needle_guide_was_on", "the needle was in the probe’s guide, which holds it in the picture’s plane"},
    {"no_view_shows_target", "no picture of this case can show the target"},
    {"nothing_done", "nothing was done that could be judged"},
    {"no_movement", "the tip did not move"},
    {"never_punctured", "the skin was never punctured"},
    {"nothing_decided", "no decision was made: neither by word nor by puncture"},
    {"no_step_asked_for", "the case asks for none of the graded steps"},
    {"breath_never_held", "the breath was never held"},
    {"no_exposure", "no X-ray exposure was made"},
    {"fewer_than_two_views", "the target was not looked at from two directions"},
    {"no_movement_of_5_mm_s", "the tip never moved as fast as 5 mm/s"},
    {"no_picture_plane", "the probe’s axes gave no picture plane while the needle advanced"},
    {"not_in_target_structure", "the tip did not end in the target structure"},
    {"not_in_tissue_at_the_end", "the tip was not in tissue at the end"},
    {"under_1_mm_of_advance", "the needle advanced by less than 1 mm in tissue"},
    {"under_1_s", "the attempt lasted less than 1 s"},
    {"under_1_s_in_tissue", "the tip was in tissue for less than 1 s"},
    {"under_1_s_in_tissue_with_a_live_picture", "the tip was in tissue for less than 1 s with a live picture"},
    {"under_5_mm_from_the_skin", "the tip ended less than 5 mm from where it entered"},
    {"too_short", "it was too short"},
    {"not_finite", "the calculation gave no finite number"},
    // What the library holds of it (grade.cpp).
    {"other_version",
     "its pass rule names another version of the metric than was measured; `seldinger recompute` adds the versions "
     "in "
     "force, and a new version of the case names them"},
    {"not_stored", "it was not stored with the attempt; `seldinger recompute` adds it"},
    {"not_measured", "it was not measured"},
    {"no_reason_stored", "no reason was stored with it"},
    // Why an attempt is not graded (grade.cpp).
    {"interrupted", "the program ended before the attempt did"},
    {"device_lost", "a device was lost during the attempt"},
    {"tracking_gaps", "tracking was lost for more than 5 % of the time"},
    {"tracking_slow", "tracking was slower than 60 Hz"},
    {"tracking_jumps", "tracking jumped faster than a hand can move"},
    {"tracking_repaired", "more than 1 % of the tracked poses had to be repaired"},
    {"way_impossible",
     "the needle came through a cut side of the CT or through the table, left the body on the other side, or was "
     "in "
     "the body from the start"},
    {"quality_not_measured", "the quality of its recording was not measured; `seldinger recompute` measures it"},
};

}  // namespace

std::span<const ReasonWords> all_reason_words() {
  return kReasons;
}

const ReasonWords* find_reason_words(std::string_view code) noexcept {
  const auto found = std::find_if(std::begin(kReasons), std::end(kReasons),
                                  [&](const ReasonWords& one) { return one.code == code; });
  return found == std::end(kReasons) ? nullptr : &*found;
}

std::string reason_words(std::string_view code) {
  const ReasonWords* found = find_reason_words(code);
  return found != nullptr ? std::string(found->words) : plain_code(code);
}

}  // namespace seldinger::assessment
