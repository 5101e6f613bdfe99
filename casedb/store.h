// What the library is asked: one function per question, its SQL beside it in store/*.sql. Ids are UUIDv7 text,
// times microseconds since 1970 UTC. Every write is one transaction: it is stored whole and acknowledged, or not at
// all.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assessment/grading/standard.h"
#include "assessment/metrics/metric.h"
#include "assessment/procedure/steps.h"
#include "casedb/case_setting.h"
#include "casedb/library.h"
#include "casedb/privacy.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/case/lesion_form.h"
#include "sim/case/recording.h"
#include "sim/case/servo_record.h"
#include "sim/volume/classes.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

enum class Role { trainee, mentor, researcher, director, admin };
std::string name_of(Role role);
std::optional<Role> role_from(const std::string& name);

// As the database and the command line write them: mpr, xray, ultrasound; supine, prone, lateral_left, …
std::string name_of(cases::Modality modality);
std::optional<cases::Modality> modality_from(const std::string& name);
// All of them, as a usage tells: "mpr, xray or ultrasound".
std::string modality_names();
std::string name_of(cases::PatientPosition position);
std::optional<cases::PatientPosition> position_from(const std::string& name);

// --- cases ------------------------------------------------------------------------------------------------------
struct NewCase : CaseSetting {
  std::string title;   // never from the source
  std::string origin;  // "import" or "phantom:<version>"
  volume::Volume volume;
  cases::Mesh skin;
  std::optional<volume::LabelMap> labels;                       // built-in case only
  std::vector<std::pair<std::string, std::string>> attributes;  // the allow-list, name → value
  std::vector<base::Problem> warnings;
  int slices_used = 0;
  FaceState face_state = FaceState::unchecked;
  bool no_burned_in_text = false;                   // somebody looked
  std::optional<std::string> burned_in_checked_by;  // person_id, when it was a person of this library
  std::vector<Dropped> dropped;
};

struct CaseRow : CaseSetting {
  std::string case_id, title, state /* "draft" */, origin;
  std::int64_t created_us = 0;
  glm::ivec3 size_voxels{0};
  glm::dvec3 spacing_mm{0.0};
  glm::dmat4 lps_from_voxel{1.0};
  int hu_min = 0, hu_max = 0, slices_used = 0;
  std::string volume_sha256, skin_sha256, labels_sha256 /* may be empty */,
      classes_sha256 /* empty: stored before schema 3 */;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::vector<base::Problem> warnings;
  std::string family_id;  // the case_id of version 1
  int version = 1;
  bool own_cohort_only = false;  // published without a second person's review
  FaceState face_state = FaceState::unchecked;
  std::optional<BurnedInCheck> burned_in_checked;  // nothing: nobody has confirmed that no text is burned in
  std::vector<Dropped> dropped;
};

struct LesionRow {
  std::string lesion_id, case_id;
  cases::LesionForm form;
  cases::Lesion lesion;  // without its shape: that is made with the scene
  std::int64_t created_us = 0;
};

// Also computes the tissue classes and stores them.
std::string add_case(Library& library, const NewCase& new_case);
std::vector<CaseRow> list_cases(Library& library);  // oldest first
// The same for lists of thousands: without attributes, warnings and what was dropped.
std::vector<CaseRow> list_case_heads(Library& library);
base::Result<CaseRow> find_case(Library& library, const std::string& case_id);  // `no_case`
base::Result<volume::Volume> load_volume(Library& library, const CaseRow& row);
base::Result<cases::Mesh> load_skin(Library& library, const CaseRow& row);
base::Result<volume::LabelMap> load_labels(Library& library, const CaseRow& row);  // `no_labels`
// One class per voxel, as add_case stored them. A case from before schema 3 has none: they are computed, in about a
// second for 512 x 512 x 100 voxels.
base::Result<std::vector<volume::TissueClass>> load_classes(Library& library, const CaseRow& row);

// Keeps that a person (or nobody known) looked through the slices and saw no text: `no_case`, `no_person`. The
// first confirmation stays.
base::Result<void> confirm_no_burned_in_text(Library& library, const std::string& case_id,
                                             const std::optional<std::string>& person_id);

// `no_case`, `not_a_draft`, `bad_lesion` (radius or numbers not sound, centre outside the volume, larger than the
// volume).
base::Result<std::string> add_lesion(Library& library, const std::string& case_id, const cases::LesionForm& form);
// A plain sphere.
base::Result<std::string> add_lesion(Library& library, const std::string& case_id, const cases::Lesion& lesion);
// Of one case, oldest first; of every one, case by case.
std::vector<LesionRow> list_lesions(Library& library, const std::optional<std::string>& case_id = {});

// --- attempts ---------------------------------------------------------------------------------------------------
using MetricValue = assessment::MetricValue;

// The operator_name of what a person did; all others are simulated, also in a person's name.
inline constexpr std::string_view kPersonOperator = "person";

// What is known of an attempt when it begins.
struct AttemptHead {
  std::string case_id, lesion_id;
  std::optional<std::string> person_id;  // whose; none for a simulation of nobody
  std::string operator_name;             // "novice", …, or kPersonOperator
  std::uint64_t seed = 0;                // simulated operators
  std::string program_version;
  cases::Instrument instrument;
  cases::Picture picture;
  cases::Approach approach = cases::Approach::in_plane;
  std::int64_t started_us = 0;
  // For how long it lay interrupted before somebody went on with it; none: it did not, or nobody knows.
  std::optional<double> away_s{};
  bool synthetic() const noexcept { return operator_name != kPersonOperator; }
};

// Interrupted: the program that made it was gone before it could say.
enum class AttemptEnd { fired, stopped, time_limit, device_lost, interrupted };
std::string name_of(AttemptEnd end);

// What is known beside its recording when it has ended.
struct AttemptOutcome {
  std::optional<AttemptEnd> end{};
  std::vector<MetricValue> metrics;
  std::vector<assessment::StepResult> steps{};
  std::vector<std::byte> picture_png;         // the picture at the moment of firing; may be empty
  std::optional<cases::ServoRecord> servo{};  // none: it ran in virtual time
};

struct NewAttempt : AttemptHead, AttemptOutcome {
  double duration_s = 0.0;
  cases::Recording recording;
};

struct AttemptRow : AttemptHead {
  std::string attempt_id, case_title, picture_sha256;
  cases::Lesion lesion;
  double duration_s = 0.0;
  std::uint32_t step_version = 0;
  std::optional<AttemptEnd> end{};           // none: stored before schema 5
  std::vector<MetricValue> metrics;          // newest version of each
  std::vector<MetricValue> older_metrics{};  // what was stored by older versions
};

// `no_case`, `no_lesion`, `no_person`, `no_attempts_left` (a person has begun as many as the case allows). Durable
// when it returns.
base::Result<std::string> add_attempt(Library& library, const NewAttempt& attempt);
// Newest first; `count` of them from the one at `first`, which is 0 for the newest.
std::vector<AttemptRow> list_attempts(Library& library, std::size_t first = 0,
                                      std::size_t count = std::numeric_limits<std::size_t>::max());
std::size_t count_attempts(Library& library);
std::vector<AttemptRow> list_attempts_of(Library& library, const std::string& person_id);  // newest first
std::vector<AttemptRow> list_attempts_on(Library& library, const std::string& case_id);    // newest first
// Those on a case whose values may make a band: of people who were consultants when they began, or of the simulated
// expert (of that the newest 200); newest first.
std::vector<AttemptRow> list_expert_attempts(Library& library, const std::string& case_id,
                                             assessment::SetKind kind);
base::Result<AttemptRow> find_attempt(Library& library, const std::string& attempt_id);  // `no_attempt`
base::Result<cases::Recording> load_recording(Library& library, const std::string& attempt_id);
// Its steps, newest version of each, in order; none: stored before schema 8, and not recomputed since.
std::vector<assessment::StepResult> list_steps(Library& library, const std::string& attempt_id);
std::optional<cases::ServoRecord> find_servo_record(Library& library, const std::string& attempt_id);
// Those whose version is not there yet: older values are kept. How many; `no_attempt`.
base::Result<std::size_t> add_metrics(Library& library, const std::string& attempt_id,
                                      const std::vector<MetricValue>& metrics);
// The same of its steps; all of a version are added, or none.
base::Result<std::size_t> add_steps(Library& library, const std::string& attempt_id,
                                    const std::vector<assessment::StepResult>& steps);

// An attempt that is stored while it runs. Each chunk is durable when add_chunk returns; a program that dies leaves
// an open attempt behind, for somebody else to close as interrupted.
struct OpenAttempt : AttemptHead {
  std::string attempt_id;
  int chunks = 0;  // stored so far
};
base::Result<std::string> open_attempt(Library& library, const AttemptHead& head);  // refuses as add_attempt
// Refused: `no_attempt`, `incomplete` (its sequence is not the next one).
base::Result<void> add_chunk(Library& library, const std::string& attempt_id, const cases::RecordingChunk& chunk);
base::Result<cases::Recording> load_open_recording(Library& library, const std::string& attempt_id);
// Somebody goes on with one that a program left behind: for how long nobody was at it, since the last piece was
// stored and by the wall's clock, is kept with it as far as that is known. `no_attempt`.
base::Result<void> note_resumption(Library& library, const std::string& attempt_id);
std::vector<OpenAttempt> list_open_attempts(Library& library);  // oldest first; running ones too
// Makes it an attempt like any other. Refused: `no_attempt`, and as recording_from_chunks.
base::Result<void> close_attempt(Library& library, const std::string& attempt_id, const AttemptOutcome& outcome);

// --- people -----------------------------------------------------------------------------------------------------
// Who somebody is beside a role: what consultants do sets the standard (assessment/grading/standard.h).
enum class Level { student, trainee, consultant };
std::string name_of(Level level);
std::optional<Level> level_from(const std::string& name);

struct Account {
  std::string person_id, login_name;
  Role role = Role::trainee;
  bool enabled = true;
  std::string password_mark{};   // another one after each change of the password; says nothing about it
  std::optional<Level> level{};  // in list_users: what is known last
};

// What add_user would refuse in any library: `bad_name`, `weak_password`.
base::Result<void> check_new_user(const std::string& name, const std::string& password);

// `bad_name` (1–64 printable characters, no leading or trailing space), `name_taken`, `weak_password` (8–128
// bytes). Names compare without regard to ASCII case.
base::Result<std::string> add_user(Library& library, const std::string& name, Role role,
                                   const std::string& password);
std::vector<Account> list_users(Library& library);  // oldest first; those who have a name
base::Result<void> set_password(Library& library, const std::string& name,
                                const std::string& password);  // `no_user`, `weak_password`
base::Result<void> set_enabled(Library& library, const std::string& name, bool enabled);  // `no_user`
// From now on; what was before stays, and with it what earlier attempts count as. `no_user`.
base::Result<void> set_level(Library& library, const std::string& name, Level level);
// The account when name and password fit and it is enabled; takes the same time whether or not the name exists.
std::optional<Account> log_in(Library& library, const std::string& name, const std::string& password);

}  // namespace seldinger::casedb
