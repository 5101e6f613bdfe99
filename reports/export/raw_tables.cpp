#include "reports/export/raw_tables.h"

#include <algorithm>

#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "casedb/attempts/condition_table.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {
namespace {

constexpr const char* kNotInUse = "another modality";
constexpr const char* kNoBeam = "no pulse of a fluoroscope (another modality, or a held image)";
constexpr const char* kNoPlane = "another modality than ultrasound, or recorded before it was kept";
constexpr const char* kOff = "off, or another modality";
constexpr const char* kWholeBox = "the box is nearly all of the picture, or another modality";
constexpr const char* kAsTheCase = "as the case's picture has it, or another modality";
constexpr const char* kAtRest = "tissue at the tip is where it is at rest: at the tip";
constexpr const char* kRestTip = "where the tissue at the tip lies in a patient at rest, as the CT does, LPS";
constexpr const char* kAttemptName = "key to attempts.csv";

bool core(const casedb::AttemptRow& row) {
  return row.instrument.kind == cases::InstrumentKind::core;
}

CsvLine& place(CsvLine& line, bool there, double value) {
  return there ? line.number(value) : line.nothing();
}

void write_condition(CsvLine& line, const casedb::ConditionRow& row, const casedb::ConditionValue& value) {
  if (const bool* flag = std::get_if<bool>(&value))
    line.flag(*flag);
  else if (const std::string* words = std::get_if<std::string>(&value))
    line.text(*words);
  else if (const double* number = std::get_if<double>(&value); number == nullptr)
    line.nothing();
  else if (row.kind == casedb::ConditionKind::whole)
    line.whole(static_cast<std::int64_t>(*number));
  else
    line.number(*number);
}

template <typename Fact>
Column<Fact> attempt_name() {
  return {{"attempt", "text", "", "", kAttemptName},
          [](CsvLine& line, const Fact& fact) { line.text(*fact.attempt); }};
}

}  // namespace

const std::vector<Column<AttemptFacts>>& attempt_columns() {
  using Facts = AttemptFacts;
  // A long function, but a plain table: one entry for each column, in the order of the file.
  static const std::vector<Column<Facts>> columns = {
      // Whose attempt it is.
      {{"attempt", "text", "", "", "this export's name for the attempt; reveals neither when nor whose it was"},
       [](CsvLine& line, const Facts& f) { line.text(f.names.attempt); }},
      {{"person", "text", "", "simulated, in no person's name",
        "this export's name for the person, S- for a simulated one; the same in another export only with the same "
        "key"},
       [](CsvLine& line, const Facts& f) { f.names.person ? line.text(*f.names.person) : line.nothing(); }},
      {{"person_attempt", "integer", "", "simulated, in no person's name",
        "number of the attempt among the person's in the library, from 1, across all cases"},
       [](CsvLine& line, const Facts& f) {
         f.person_attempt ? line.whole(std::int64_t{*f.person_attempt}) : line.nothing();
       }},
      {{"days_since_first", "number", "d", "simulated, in no person's name",
        "from the start of the person's first attempt in the library to this one's; no date is exported"},
       [](CsvLine& line, const Facts& f) { line.number(f.days_since_first); }},
      // Who or what moved the hands.
      {{"synthetic", "flag", "", "",
        "1: a simulated operator moved the hands: test data, which says nothing about people"},
       [](CsvLine& line, const Facts& f) { line.flag(f.row->synthetic()); }},
      {{"operator", "text", "", "",
        "person, or the simulated operator: novice, intermediate, expert, custom (somebody's own file)"},
       [](CsvLine& line, const Facts& f) { line.text(own_or_known_operator(f.row->operator_name)); }},
      {{"seed", "integer", "", "a person's attempt", "the simulated operator's, unsigned 64 bits"},
       [](CsvLine& line, const Facts& f) {
         f.row->synthetic() ? line.whole(std::uint64_t{f.row->seed}) : line.nothing();
       }},
      // The case.
      {{"case", "text", "", "", "this export's name for the case; its title is somebody's words and is left out"},
       [](CsvLine& line, const Facts& f) { line.text(f.names.case_id); }},
      {{"case_version", "integer", "", "", "version of the case within its family, from 1"},
       [](CsvLine& line, const Facts& f) { line.whole(std::int64_t{f.of_case->version}); }},
      {{"case_origin", "text", "", "", "import: a CT; phantom:VERSION: built in"},
       [](CsvLine& line, const Facts& f) { line.text(f.of_case->origin); }},
      // The target.
      {{"target", "text", "", "", "this export's name for the lesion that was the target"},
       [](CsvLine& line, const Facts& f) { line.text(f.names.target); }},
      {{"target_x_mm", "number", "mm", "", "the target's centre, LPS"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->lesion.center_lps_mm.x); }},
      {{"target_y_mm", "number", "mm", "", "the target's centre, LPS"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->lesion.center_lps_mm.y); }},
      {{"target_z_mm", "number", "mm", "", "the target's centre, LPS"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->lesion.center_lps_mm.z); }},
      {{"target_radius_mm", "number", "mm", "", "of the sphere, or of the ball of its volume"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->lesion.radius_mm); }},
      // The guidance.
      {{"modality", "text", "", "", "mpr: a CT slice under the probe; ultrasound; xray: fluoroscopy"},
       [](CsvLine& line, const Facts& f) { line.text(casedb::name_of(f.row->picture.modality)); }},
      {{"approach", "text", "", "", "in_plane or out_of_plane, of needle to picture; meaningless under xray"},
       [](CsvLine& line, const Facts& f) { line.text(base::name_of(cases::kApproachNames, f.row->approach)); }},
      {{"probe", "text", "", kNotInUse, "ultrasound: its name"},
       [](CsvLine& line, const Facts& f) {
         f.row->picture.probe.empty() ? line.nothing() : line.text(f.row->picture.probe);
       }},
      {{"picture_depth_mm", "number", "mm", "under xray", "depth of the picture"},
       [](CsvLine& line, const Facts& f) {
         place(line, f.row->picture.modality != cases::Modality::xray, f.row->picture.depth_mm);
       }},
      {{"picture_rate_hz", "number", "Hz", "under xray", "pictures a second"},
       [](CsvLine& line, const Facts& f) {
         place(line, f.row->picture.modality != cases::Modality::xray, f.row->picture.rate_hz);
       }},
      // The needle. Throw, notch and dead tip belong to core needles.
      {{"instrument", "text", "", "", "access: the tip decides; core: the fired notch"},
       [](CsvLine& line, const Facts& f) { line.text(core(*f.row) ? "core" : "access"); }},
      {{"needle_length_mm", "number", "mm", "", "the needle's length"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->instrument.length_mm); }},
      {{"needle_radius_mm", "number", "mm", "", "the needle's outer radius"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->instrument.radius_mm); }},
      {{"throw_mm", "number", "mm", "no core needle", "how far the tip goes when fired"},
       [](CsvLine& line, const Facts& f) { place(line, core(*f.row), f.row->instrument.throw_mm); }},
      {{"notch_mm", "number", "mm", "no core needle", "length of the sample notch"},
       [](CsvLine& line, const Facts& f) { place(line, core(*f.row), f.row->instrument.notch_mm); }},
      {{"dead_tip_mm", "number", "mm", "no core needle", "from the notch's end to the tip"},
       [](CsvLine& line, const Facts& f) { place(line, core(*f.row), f.row->instrument.dead_tip_mm); }},
      // How long it took, and how it ended.
      {{"duration_s", "number", "s", "", "length of the recording"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->duration_s); }},
      {{"end", "text", "", "stored before it was kept",
        "fired, stopped, time_limit, device_lost, or interrupted (the program ended)"},
       [](CsvLine& line, const Facts& f) {
         f.row->end ? line.text(casedb::name_of(*f.row->end)) : line.nothing();
       }},
      {{"away_s", "number", "s", "it was not interrupted and resumed, or for how long is not known",
        "how long it was interrupted, by the wall clock, before somebody resumed it"},
       [](CsvLine& line, const Facts& f) { line.number(f.row->away_s); }},
      // What recorded it.
      {{"program_version", "text", "", "", "of the program that recorded it"},
       [](CsvLine& line, const Facts& f) { line.text(f.row->program_version); }},
      {{"step_version", "integer", "", "", "of the simulation; a replay needs the same"},
       [](CsvLine& line, const Facts& f) { line.whole(std::uint64_t{f.row->step_version}); }},
  };
  return columns;
}

const std::vector<Column<MetricFact>>& metric_columns() {
  using Fact = MetricFact;
  static const std::vector<Column<Fact>> columns = {
      attempt_name<Fact>(),
      {{"metric", "text", "", "", "its id; a column of attempts.csv"},
       [](CsvLine& line, const Fact& f) { line.text(f.metric->id); }},
      {{"version", "integer", "", "", "of its definition; older ones stay beside newer ones"},
       [](CsvLine& line, const Fact& f) { line.whole(std::int64_t{f.metric->version}); }},
      {{"current", "flag", "", "", "1: the version that attempts.csv shows"},
       [](CsvLine& line, const Fact& f) {
         const assessment::MetricInfo* info = assessment::find_metric(f.metric->id);
         line.flag(info != nullptr && info->version == f.metric->version);
       }},
      {{"value", "number", "that of the row", "there is none: see reason", "the value; yes is 1, no is 0"},
       [](CsvLine& line, const Fact& f) { line.number(f.metric->value); }},
      {{"unit", "text", "", "", "of value"}, [](CsvLine& line, const Fact& f) { line.text(f.metric->unit); }},
      {{"reason", "text", "", "there is a value", "why there is none; never read it as 0"},
       [](CsvLine& line, const Fact& f) { line.text(f.metric->reason); }},
  };
  return columns;
}

const std::vector<Column<StepFact>>& step_columns() {
  using Fact = StepFact;
  static const std::string steps = [] {
    std::string text = "in the order in which they are to be done:";
    for (const assessment::StepInfo& step : assessment::procedure_steps())
      text += std::string(&step == assessment::procedure_steps().data() ? " " : "; ") + step.id + ": " + step.words;
    return text;
  }();
  static const std::vector<Column<Fact>> columns = {
      attempt_name<Fact>(),
      {{"step", "text", "", "", steps}, [](CsvLine& line, const Fact& f) { line.text(f.step->id); }},
      {{"version", "integer", "", "", "of the steps' meaning; the newest that is stored"},
       [](CsvLine& line, const Fact& f) { line.whole(std::int64_t{f.step->version}); }},
      {{"state", "text", "", "", "done, skipped, violated, or not_asked (it does not apply here)"},
       [](CsvLine& line, const Fact& f) { line.text(assessment::name_of(f.step->state)); }},
      {{"t_s", "number", "s", "it was not done, or not asked for",
        "when it was done (skipped: too late) or violated, since the attempt began"},
       [](CsvLine& line, const Fact& f) { line.number(f.step->t_s); }},
      {{"reason", "text", "", "it was asked", "why it was not"},
       [](CsvLine& line, const Fact& f) { line.text(f.step->reason); }},
      {{"how", "text", "", "it was neither, or stored before this was kept",
        "of done: shown (by an action) or said; of skipped: said, where only an action counts"},
       [](CsvLine& line, const Fact& f) {
         f.step->how ? line.text(assessment::name_of(*f.step->how)) : line.nothing();
       }},
  };
  return columns;
}

const std::vector<Column<PoseFact>>& pose_columns() {
  using Fact = PoseFact;
  static const std::vector<Column<Fact>> columns = {
      attempt_name<Fact>(),
      {{"t_s", "number", "s", "", "since the attempt began; 100 rows a second, and one of the endpoint"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.t_s); }},
      {{"needle_tip_x_mm", "number", "mm", "", "the needle's tip, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.tip_lps_mm.x); }},
      {{"needle_tip_y_mm", "number", "mm", "", "the needle's tip, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.tip_lps_mm.y); }},
      {{"needle_tip_z_mm", "number", "mm", "", "the needle's tip, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.tip_lps_mm.z); }},
      {{"needle_dir_x", "number", "", "", "from hub to tip, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.needle_direction.x); }},
      {{"needle_dir_y", "number", "", "", "from hub to tip, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.needle_direction.y); }},
      {{"needle_dir_z", "number", "", "", "from hub to tip, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.needle_direction.z); }},
      {{"probe_origin_x_mm", "number", "mm", "", "middle of the probe's face, LPS; meaningless under xray"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_origin_lps_mm.x); }},
      {{"probe_origin_y_mm", "number", "mm", "", "middle of the probe's face, LPS; meaningless under xray"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_origin_lps_mm.y); }},
      {{"probe_origin_z_mm", "number", "mm", "", "middle of the probe's face, LPS; meaningless under xray"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_origin_lps_mm.z); }},
      {{"probe_axial_x", "number", "", "", "into the body, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_axial.x); }},
      {{"probe_axial_y", "number", "", "", "into the body, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_axial.y); }},
      {{"probe_axial_z", "number", "", "", "into the body, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_axial.z); }},
      {{"probe_lateral_x", "number", "", "", "along the probe's face, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_lateral.x); }},
      {{"probe_lateral_y", "number", "", "", "along the probe's face, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_lateral.y); }},
      {{"probe_lateral_z", "number", "", "", "along the probe's face, unit vector, LPS"},
       [](CsvLine& line, const Fact& f) { line.number(f.pose.probe_lateral.z); }},
      {{"fire", "flag", "", "", "1: the endpoint, with the tip as it was before any throw"},
       [](CsvLine& line, const Fact& f) { line.flag(f.fire); }},
      {{"rest_tip_x_mm", "number", "mm", kAtRest, kRestTip},
       [](CsvLine& line, const Fact& f) {
         f.pose.rest_tip_lps_mm ? line.number(f.pose.rest_tip_lps_mm->x) : line.nothing();
       }},
      {{"rest_tip_y_mm", "number", "mm", kAtRest, kRestTip},
       [](CsvLine& line, const Fact& f) {
         f.pose.rest_tip_lps_mm ? line.number(f.pose.rest_tip_lps_mm->y) : line.nothing();
       }},
      {{"rest_tip_z_mm", "number", "mm", kAtRest, kRestTip},
       [](CsvLine& line, const Fact& f) {
         f.pose.rest_tip_lps_mm ? line.number(f.pose.rest_tip_lps_mm->z) : line.nothing();
       }},
  };
  return columns;
}

const std::vector<Column<ForceFact>>& force_columns() {
  using Fact = ForceFact;
  static const std::vector<Column<Fact>> columns = {
      attempt_name<Fact>(),
      {{"t_s", "number", "s", "", "since the attempt began, 100 rows a second"},
       [](CsvLine& line, const Fact& f) { line.number(f.force.t_s); }},
      {{"needle_axial_n", "number", "N", "", "what the tissue model commands along the needle; > 0 resists"},
       [](CsvLine& line, const Fact& f) { line.number(f.force.needle_axial_n); }},
      {{"needle_lateral_n", "number", "N", "", "the same across the needle, 0 or more"},
       [](CsvLine& line, const Fact& f) { line.number(f.force.needle_lateral_n); }},
      {{"probe_n", "number", "N", "", "the same at the probe, 0 or more"},
       [](CsvLine& line, const Fact& f) { line.number(f.force.probe_n); }},
  };
  return columns;
}

const std::vector<Column<FrameFact>>& frame_columns() {
  using Fact = FrameFact;
  static const std::vector<Column<Fact>> columns = {
      attempt_name<Fact>(),
      {{"t_s", "number", "s", "", "when the picture appeared, since the attempt began"},
       [](CsvLine& line, const Fact& f) { line.number(f.frame.t_s); }},
      {{"live", "flag", "", "", "0: frozen, or the last image held"},
       [](CsvLine& line, const Fact& f) { line.flag(f.frame.live); }},
      {{"needle_tip", "flag", "", "", "1: the picture shows the tip"},
       [](CsvLine& line, const Fact& f) { line.flag(f.frame.needle_tip); }},
      {{"target", "flag", "", "", "1: the picture shows the target"},
       [](CsvLine& line, const Fact& f) { line.flag(f.frame.target); }},
      {{"needle_length_mm", "number", "mm", "", "how much of the needle the picture shows"},
       [](CsvLine& line, const Fact& f) { line.number(f.frame.needle_length_mm); }},
      {{"tip_within_2_mm", "flag", "", kNoPlane, "1: the tip lies within 2 mm of the plane, in the field"},
       [](CsvLine& line, const Fact& f) {
         f.frame.near_plane ? line.flag(f.frame.near_plane->tip_2_mm) : line.nothing();
       }},
      {{"target_within_2_mm", "flag", "", kNoPlane, "1: the target's centre does"},
       [](CsvLine& line, const Fact& f) {
         f.frame.near_plane ? line.flag(f.frame.near_plane->target_2_mm) : line.nothing();
       }},
      {{"tip_within_5_mm", "flag", "", kNoPlane, "1: the tip lies within 5 mm of the plane, in the field"},
       [](CsvLine& line, const Fact& f) {
         f.frame.near_plane ? line.flag(f.frame.near_plane->tip_5_mm) : line.nothing();
       }},
      {{"target_within_5_mm", "flag", "", kNoPlane, "1: the target's centre does"},
       [](CsvLine& line, const Fact& f) {
         f.frame.near_plane ? line.flag(f.frame.near_plane->target_5_mm) : line.nothing();
       }},
      {{"lao_deg", "number", "deg", kNoBeam, "the detector to the patient's left; negative: RAO"},
       [](CsvLine& line, const Fact& f) { f.frame.beam ? line.number(f.frame.beam->lao_deg) : line.nothing(); }},
      {{"cranial_deg", "number", "deg", kNoBeam, "the detector to the head; negative: caudal"},
       [](CsvLine& line, const Fact& f) {
         f.frame.beam ? line.number(f.frame.beam->cranial_deg) : line.nothing();
       }},
      {{"kv", "number", "kV", kNoBeam, "the tube's voltage"},
       [](CsvLine& line, const Fact& f) { f.frame.beam ? line.number(f.frame.beam->kv) : line.nothing(); }},
      {{"ma", "number", "mA", kNoBeam, "the tube's current"},
       [](CsvLine& line, const Fact& f) { f.frame.beam ? line.number(f.frame.beam->ma) : line.nothing(); }},
      {{"air_kerma_mgy", "number", "mGy", kNoBeam, "simulated, at the interventional reference point"},
       [](CsvLine& line, const Fact& f) {
         f.frame.beam ? line.number(f.frame.beam->air_kerma_mgy) : line.nothing();
       }},
      {{"dap_mgy_cm2", "number", "mGy·cm²", kNoBeam, "simulated dose–area product of the pulse"},
       [](CsvLine& line, const Fact& f) {
         f.frame.beam ? line.number(f.frame.beam->dap_mgy_cm2) : line.nothing();
       }},
      {{"collimated_share", "number", "", kNoBeam, "of the whole field, shut off"},
       [](CsvLine& line, const Fact& f) {
         f.frame.beam ? line.number(f.frame.beam->collimated_share) : line.nothing();
       }},
      {{"beam_s", "number", "s", kNoBeam, "what the pulse stands for: 1 / pulse rate"},
       [](CsvLine& line, const Fact& f) { f.frame.beam ? line.number(f.frame.beam->beam_s) : line.nothing(); }},
      {{"arm_moving", "flag", "", kNoBeam, "1: arm or table moved during the pulse"},
       [](CsvLine& line, const Fact& f) { f.frame.beam ? line.flag(f.frame.beam->arm_moving) : line.nothing(); }},
      {{"hand_in_beam", "flag", "", kNoBeam, "1: the hand at the needle was in the beam"},
       [](CsvLine& line, const Fact& f) { f.frame.beam ? line.flag(f.frame.beam->hand_in_beam) : line.nothing(); }},
      {{"console_depth_mm", "number", "mm", kAsTheCase, "depth of an ultrasound picture, as it was set"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.depth_mm != 0.0, f.console.depth_mm); }},
      {{"console_focus_mm", "number", "mm", kAsTheCase, "its focus"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.focus_mm != 0.0, f.console.focus_mm); }},
      {{"console_frequency_mhz", "number", "MHz", kAsTheCase, "its frequency"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.frequency_mhz != 0.0, f.console.frequency_mhz); }},
      {{"console_slice_mm", "number", "mm", kAsTheCase, "how far beside the probe's plane a slice of the CT lies"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.slice_mm != 0.0, f.console.slice_mm); }},
      {{"console_colour_mm_s", "number", "mm/s", kOff, "colour Doppler: the speed at which it aliases"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.colour_mm_s != 0.0, f.console.colour_mm_s); }},
      {{"console_lean_deg", "number", "deg", kOff, "how far its beams leaned towards the face's last one"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.colour_mm_s != 0.0, f.console.lean_deg); }},
      {{"console_box_across", "number", "", kWholeBox, "middle of its box, a share of the picture's beams"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.box_across != 0.0, f.console.box_across); }},
      {{"console_box_down", "number", "", kWholeBox, "and of its depth"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.box_down != 0.0, f.console.box_down); }},
      {{"console_compound_deg", "number", "deg", kOff, "spatial compounding: how far looks are apart"},
       [](CsvLine& line, const Fact& f) { place(line, f.console.compound_deg != 0.0, f.console.compound_deg); }},
  };
  return columns;
}

const std::vector<Column<EventFact>>& event_columns() {
  using Fact = EventFact;
  static const std::string kinds = [] {
    std::string text;
    for (const RecordedEventInfo& kind : recorded_event_kinds())
      text += (text.empty() ? "" : "; ") + kind.kind + ": " + kind.about;
    return text;
  }();
  static const std::vector<Column<Fact>> columns = {
      attempt_name<Fact>(),
      {{"t_s", "number", "s", "", "since the attempt began"},
       [](CsvLine& line, const Fact& f) { line.number(f.event.t_s); }},
      {{"source", "text", "", "", "hand: a button; else who it came from: trainee, mentor, patient, workstation"},
       [](CsvLine& line, const Fact& f) { line.text(f.event.info->source); }},
      {{"event", "text", "", "", kinds}, [](CsvLine& line, const Fact& f) { line.text(f.event.info->kind); }},
      {{"wall_s", "number", "s", "no pause",
        "how long the pause was, by the wall clock: not part of the attempt's time"},
       [](CsvLine& line, const Fact& f) { line.number(f.event.wall_s); }},
      {{"length_mm", "number", "mm", "none was given with it", "the depth that was measured or planned"},
       [](CsvLine& line, const Fact& f) { line.number(f.event.length_mm); }},
  };
  return columns;
}

namespace {

std::string better_of(const assessment::MetricInfo& info) {
  switch (info.direction) {
    case assessment::Direction::lower_is_better:
      return "lower";
    case assessment::Direction::higher_is_better:
      return "higher";
    case assessment::Direction::none:
      break;
  }
  return "neither";
}

}  // namespace

const std::vector<ColumnInfo>& attempt_conditions() {
  static const std::vector<ColumnInfo> columns = [] {
    const auto type_of = [](casedb::ConditionKind kind) {
      return kind == casedb::ConditionKind::flag    ? "flag"
             : kind == casedb::ConditionKind::whole ? "integer"
             : kind == casedb::ConditionKind::text  ? "text"
                                                    : "number";
    };
    std::vector<ColumnInfo> all;
    for (const casedb::ConditionRow& row : casedb::condition_rows())
      all.push_back({row.id, type_of(row.kind), row.unit, row.missing, row.about});
    return all;
  }();
  return columns;
}

const std::vector<Column<PersonFact>>& fact_columns() {
  using Fact = PersonFact;
  static const std::string known = [] {
    std::string text = "which question: ";
    for (const casedb::FactInfo& fact : casedb::fact_infos())
      text += (&fact == casedb::fact_infos().data() ? "" : "; ") + std::string(fact.id) + ": " +
              std::string(fact.words);
    return text;
  }();
  static const std::vector<Column<Fact>> columns = {
      {{"person", "text", "", "", "as in attempts.csv"},
       [](CsvLine& line, const Fact& f) { line.text(*f.person); }},
      {{"fact", "text", "", "", known}, [](CsvLine& line, const Fact& f) { line.text(f.fact->fact_id); }},
      {{"answer", "text", "", "", "as it was given; it holds until the next one"},
       [](CsvLine& line, const Fact& f) { line.text(f.fact->answer); }},
      {{"days_since_first", "number", "day", "",
        "from the person's first attempt to the answer; negative: before it"},
       [](CsvLine& line, const Fact& f) { line.number(f.days_since_first); }},
  };
  return columns;
}

const std::vector<ColumnInfo>& attempt_metrics() {
  static const std::vector<ColumnInfo> columns = [] {
    std::vector<ColumnInfo> all;
    for (const assessment::MetricInfo& info : assessment::registry())
      all.push_back({info.id, std::string(info.unit) == "bool" ? "flag" : "number", info.unit,
                     "metrics.csv has the reason, or only another version of it",
                     std::string(info.label) + ": " + info.definition, info.version, better_of(info),
                     std::string(assessment::words(info.estimand.scale)),
                     std::string(assessment::words(info.estimand.without_endpoint)),
                     std::string(assessment::words(info.estimand.aggregation))});
    return all;
  }();
  return columns;
}

std::string attempts_header() {
  CsvLine line;
  for (const auto& column : attempt_columns()) line.text(column.name);
  for (const ColumnInfo& condition : attempt_conditions()) line.text(condition.name);
  for (const ColumnInfo& metric : attempt_metrics()) line.text(metric.name);
  return line.take();
}

std::string attempt_line(const AttemptFacts& facts, Precision precision) {
  CsvLine line(precision);
  for (const auto& column : attempt_columns()) column.write(line, facts);
  for (const casedb::ConditionRow& row : casedb::condition_rows())
    write_condition(line, row, row.read(facts.row->conditions));
  const auto& metrics = facts.row->metrics;
  for (const ColumnInfo& column : attempt_metrics()) {
    const auto found = std::find_if(metrics.begin(), metrics.end(), [&](const casedb::MetricValue& metric) {
      return metric.id == column.name && metric.version == column.version;
    });
    found == metrics.end() ? line.nothing() : line.number(found->value);
  }
  return line.take();
}

std::vector<PoseFact> pose_facts(const std::string& attempt, const cases::Recording& recording) {
  std::vector<PoseFact> facts;
  facts.reserve(recording.poses.size() + 1);
  bool fired = !recording.endpoint;
  const auto fire = [&](cases::PoseSample pose) {
    pose.t_s = recording.endpoint->t_s;
    pose.tip_lps_mm = recording.endpoint->tip_lps_mm;
    pose.needle_direction = recording.endpoint->direction;
    pose.rest_tip_lps_mm = recording.endpoint->rest_tip_lps_mm;
    facts.push_back({&attempt, pose, true});
    fired = true;
  };
  for (const cases::PoseSample& pose : recording.poses) {
    if (!fired && pose.t_s >= recording.endpoint->t_s) {
      const bool same_time = pose.t_s == recording.endpoint->t_s;
      fire(same_time || facts.empty() ? pose : facts.back().pose);  // between two samples the probe stays
      if (same_time) continue;
    }
    facts.push_back({&attempt, pose, false});
  }
  if (!fired && !facts.empty()) fire(facts.back().pose);
  return facts;
}

namespace {

template <typename Row>
std::vector<ColumnInfo> infos_of(const std::vector<Column<Row>>& columns) {
  return {columns.begin(), columns.end()};
}

}  // namespace

const std::vector<TableInfo>& raw_tables() {
  static const std::vector<TableInfo> tables = [] {
    std::vector<ColumnInfo> attempts = infos_of(attempt_columns());
    attempts.insert(attempts.end(), attempt_conditions().begin(), attempt_conditions().end());
    attempts.insert(attempts.end(), attempt_metrics().begin(), attempt_metrics().end());
    return std::vector<TableInfo>{
        {"attempts.csv", "one row per attempt: how and under which conditions it was made, and each metric's value",
         std::move(attempts)},
        {"metrics.csv",
         "one row per metric of an attempt: every stored version, with the reason where there is no value",
         infos_of(metric_columns())},
        {"events.csv",
         "one row per event of an attempt; for one recorded before events were kept, only the buttons'",
         infos_of(event_columns())},
        {"steps.csv", "one row per step of an attempt's procedure; none for attempts from before steps were kept",
         infos_of(step_columns())},
        {"facts.csv", "one row per answer of a person about their experience", infos_of(fact_columns())},
        {"poses/ATTEMPT.csv", "where needle and probe were; `seldinger score --poses` reads it as it is",
         infos_of(pose_columns())},
        {"forces/ATTEMPT.csv", "the forces to be felt; no file where there were none", infos_of(force_columns())},
        {"frames/ATTEMPT.csv", "what each picture showed, and how each pulse was made", infos_of(frame_columns())}};
  }();
  return tables;
}

namespace {

// What an export without key and study has in the place of a person's exact value; empty: the value itself.
std::string_view coarse_rule(const TableInfo& table, const ColumnInfo& column) {
  if (table.file.find('/') != std::string::npos) return "no file";
  if (column.name == "days_since_first") return "whole days, two significant digits";
  return column.type == "number" ? "two significant digits" : "";
}

}  // namespace

const TableInfo& dictionary_table() {
  static const TableInfo table = [] {
    TableInfo made{"data_dictionary.csv", "what each column of each table means", {}};
    for (const char* name : {"file", "column", "type", "unit", "version", "empty_when", "description", "better",
                             "scale", "without_endpoint", "of_a_person", "of_people_without_key_and_study"})
      made.columns.push_back(
          {name, std::string_view(name) == "version" ? "integer" : "text", "", "there is none", name});
    return made;
  }();
  return table;
}

std::string data_dictionary() {
  CsvLine line;
  for (const ColumnInfo& column : dictionary_table().columns) line.text(column.name);
  std::string text = line.take();
  for (const TableInfo& table : raw_tables())
    for (const ColumnInfo& column : table.columns) {
      line.text(table.file).text(column.name).text(column.type).text(column.unit);
      column.version ? line.whole(std::int64_t{*column.version}) : line.nothing();
      line.text(column.missing.empty() ? "never" : column.missing).text(column.what);
      for (const std::string* one : {&column.better, &column.scale, &column.without_endpoint, &column.of_a_person})
        one->empty() ? line.nothing() : line.text(*one);
      const std::string_view coarse = coarse_rule(table, column);
      coarse.empty() ? line.nothing() : line.text(coarse);
      text += line.take();
    }
  return text;
}

std::string raw_readme() {
  std::string text =
      "Raw export of Seldinger: attempts at simulated punctures. Training data: nothing here is about a patient's "
      "procedure.\n\n";
  for (const TableInfo& table : raw_tables()) text += table.file + ": " + table.what + "\n";
  text +=
      "data_dictionary.csv: every column of every file: type, unit, when it is empty, what it means; for a metric "
      "also how people are compared by it: which way is better, its scale, what an attempt without an endpoint "
      "counts as, how a person's attempts become one value (those with procedure_performed = 1); and what people's "
      "values become in an export without key and study\ndatapackage.json: the tables, their columns' types and "
      "when a cell is empty, for R's and Python's frictionless\nIf they were asked for: export.sqlite, all tables "
      "in one file; slicer, points, ways and needles for 3D Slicer; xapi.json, statements for a learning record "
      "store; motion-bids, the needle's poses as a BIDS data set\n\nCSV as RFC 4180: UTF-8, comma, '.' decimals, "
      "LF, header in the first line. Numbers read back bit for bit. An empty cell is a missing value and never 0. "
      "Text that a spreadsheet would take for a formula begins with an apostrophe. Lengths in mm, coordinates LPS "
      "(x to the patient's left, y to the back, z to the head), times in seconds.\n\nMade without --key and "
      "--study, numbers of people's attempts (synthetic = 0) have two significant digits, days are whole, and "
      "there are no files of their poses, forces and frames: good for trying an analysis and for teaching, not for "
      "a result. Those who hold two exports, rounded or not, can still join them by their values: keep this folder "
      "as personal data.\n\nNames of attempts, people, cases and targets are made for this export. Rows with "
      "synthetic = 1 come from simulated operators: leave them out of every statement about people.\n";
  return text;
}

}  // namespace seldinger::reports
