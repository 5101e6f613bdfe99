// What a case asks of whoever attempts it, beside its volume: guidance, instrument, patient, and when it passes.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/rule.h"
#include "sim/base/names.h"
#include "sim/base/result.h"
#include "sim/case/case.h"

namespace seldinger::casedb {

enum class Difficulty { easy, moderate, hard };
inline constexpr auto kDifficultyNames = base::names<Difficulty>(
    {{Difficulty::easy, "easy"}, {Difficulty::moderate, "moderate"}, {Difficulty::hard, "hard"}});

// What is known at the sign-in (docs/clinical.md, "Steps around the puncture").
struct Clinic {
  std::optional<double> inr, platelets_per_nl;  // 10⁹/l
  std::string allergy, indication;              // a mentor's words; empty: none told
  bool defer = false;                           // the right decision
};

// By which law a patient breathes (docs/decisions/0084): a case's for good.
enum class BreathLaw {
  equal_holds,     // a depth of 1 is from CT to CT, and each hold is as still as the last
  drifting_holds,  // a depth of 1 is a quiet breath; holds differ and drift
  sliding_organs   // as drifting_holds, and organs slide along the wall of chest and belly
};
inline constexpr auto kBreathLawNames = base::names<BreathLaw>({{BreathLaw::equal_holds, "equal_holds"},
                                                                {BreathLaw::drifting_holds, "drifting_holds"},
                                                                {BreathLaw::sliding_organs, "sliding_organs"}});
inline constexpr BreathLaw kNewestBreathLaw = BreathLaw::sliding_organs;

// What of the patient moves. None of it: as still as the CT.
struct Motion {
  double breath_depth = 0.0;  // in breaths of its law; 0: none
  double breath_period_s = 4.0, breath_irregularity = 0.1;
  BreathLaw breath_law = kNewestBreathLaw;                  // of a version made before it: that of its time
  cases::CtBreath ct_breath = cases::CtBreath::expiration;  // and in which breath is held
  bool yields = false;                                      // tissue, to probe and needle
  std::optional<cases::Breathing> breathing() const;
};

struct CaseSetting {
  cases::Modality modality = cases::Modality::mpr;  // what it is practised with
  std::vector<cases::Modality> further_modalities;  // what it may be practised with too
  cases::Subject subject = cases::Subject::patient;
  cases::PatientPosition position = cases::PatientPosition::supine;
  cases::Instrument instrument;
  cases::Touch touch{.law = cases::kNewestTouchLaw};  // of a version made before it: steady
  cases::Approach approach = cases::Approach::in_plane;
  bool probe_is_chosen = false;  // ultrasound: by whoever attempts it; else the case takes the one that suits
  Clinic clinic;
  Motion motion;
  std::optional<glm::dvec3> planned_entry_lps_mm;
  Difficulty difficulty = Difficulty::moderate;
  std::optional<double> time_limit_s;
  std::optional<int> attempt_limit;
  cases::SightLaw sight_law = cases::kNewestSightLaw;  // of an older version: that of its time
  assessment::PassRule rule;
};

inline assessment::Manner manner_of(const CaseSetting& setting) {
  return {setting.modality, setting.approach, setting.instrument.kind};
}

std::string name_of(cases::InstrumentKind kind);
std::string name_of(cases::Subject subject);
std::optional<cases::Subject> subject_from(const std::string& name);
std::string name_of(cases::Approach approach);

// `bad_setting` with all that is not sound: lengths, laboratory values, limits, a modality twice, texts over 200
// bytes or with control characters, and what a phantom cannot have. The rule's metrics are looked at by the case's
// check.
base::Result<void> check_setting(const CaseSetting& setting);

}  // namespace seldinger::casedb
