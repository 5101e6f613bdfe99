#include "reports/words/attempt_words.h"

#include "reports/words/metric_words.h"

namespace seldinger::reports {

std::string instrument_text(const cases::Instrument& instrument) {
  return instrument.kind == cases::InstrumentKind::core ? "Core needle" : "Access needle";
}

std::string instrument_size_text(const cases::Instrument& instrument) {
  std::string text = number_text(2.0 * instrument.radius_mm, 2) + " mm across, " +
                     number_text(instrument.length_mm, 0) + " mm long";
  if (instrument.kind == cases::InstrumentKind::core) {
    text += ", throw " + number_text(instrument.throw_mm, 0) + " mm, notch " + number_text(instrument.notch_mm, 0) +
            " mm";
  }
  return text;
}

std::string lesion_text(const cases::Lesion& lesion) {
  const glm::dvec3& c = lesion.center_lps_mm;
  return "LPS (" + number_text(c.x, 1) + ", " + number_text(c.y, 1) + ", " + number_text(c.z, 1) +
         ") mm, diameter " + number_text(2.0 * lesion.radius_mm, 1) + " mm";
}

std::string picture_text(const cases::Picture& picture) {
  if (picture.modality == cases::Modality::xray) return "Fluoroscopy";
  if (picture.modality == cases::Modality::ultrasound)
    return "Ultrasound, probe " + picture.probe + ", " + number_text(picture.depth_mm, 0) + " mm deep, " +
           number_text(picture.rate_hz, 0) + " pictures a second";
  return "MPR (a plane of the CT under the probe), " + number_text(picture.width_mm, 0) + " mm wide, " +
         number_text(picture.depth_mm, 0) + " mm deep";
}

std::string approach_text(cases::Approach approach) {
  return approach == cases::Approach::in_plane ? "In plane" : "Out of plane";
}

std::string position_text(cases::PatientPosition position) {
  switch (position) {
    case cases::PatientPosition::supine:
      return "supine";
    case cases::PatientPosition::prone:
      return "prone";
    case cases::PatientPosition::lateral_left:
      return "on the left side";
    case cases::PatientPosition::lateral_right:
      return "on the right side";
  }
  return "";
}

std::string away_text(const casedb::AttemptHead& attempt) {
  if (!attempt.away_s) return "";
  struct Unit {
    double seconds, below_s;
    const char* name;
  };
  constexpr Unit kUnits[] = {{1.0, 120.0, " s"}, {60.0, 7200.0, " min"}, {3600.0, 172800.0, " hours"}};
  for (const Unit& unit : kUnits)
    if (*attempt.away_s < unit.below_s)
      return "Interrupted, and resumed after " + number_text(*attempt.away_s / unit.seconds, 0) + unit.name + ".";
  return "Interrupted, and resumed after " + number_text(*attempt.away_s / 86400.0, 0) + " days.";
}

namespace {

// The end of a UUIDv7 is random; its beginning would tell when it was made.
std::string label_of(const std::string& id) {
  return id.substr(id.size() < 6 ? 0 : id.size() - 6);
}

}  // namespace

std::string person_text(const std::string& person_id) {
  return "Person " + label_of(person_id);
}

std::string case_text(const std::string& case_id) {
  return case_id.empty() ? "A case" : "Case " + label_of(case_id);
}

std::string_view own_or_known_operator(std::string_view operator_name) {
  for (const std::string_view known : {"novice", "intermediate", "expert"})
    if (operator_name == known) return known;
  return operator_name == casedb::kPersonOperator ? casedb::kPersonOperator : "custom";
}

std::string simulated_operator_text(const std::string& operator_name) {
  return operator_name.empty() ? "Simulated operator" : "Simulated " + operator_name;
}

}  // namespace seldinger::reports
