// export.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <span>
#include <utility>

#include "app/acting/acting.h"
#include "app/attempts/export_json.h"
#include "app/cli/command.h"
#include "app/cli/key_file.h"
#include "app/cli/words.h"
#include "casedb/cases/permissions.h"
#include "casedb/people/consent.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/plans.h"
#include "reports/export/raw_export.h"

namespace seldinger::app {
namespace {

// "poses,events" into what they name; `words`: what may be named.
void choose(const std::string& text, std::span<const std::pair<std::string_view, bool*>> words,
            const std::string& usage) {
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(',', from), text.size());
    const std::string_view word = std::string_view(text).substr(from, end - from);
    const auto found = std::find_if(words.begin(), words.end(), [&](const auto& one) { return one.first == word; });
    if (found == words.end()) throw UsageError(usage);
    *found->second = true;
    from = end + 1;
  }
}

void choose_raw(const std::string& text, reports::RawChoice& choice) {
  choice.poses = choice.forces = choice.frames = choice.events = false;
  if (text == "none") return;
  const std::pair<std::string_view, bool*> words[] = {
      {"poses", &choice.poses}, {"forces", &choice.forces}, {"frames", &choice.frames}, {"events", &choice.events}};
  choose(text, words, "--raw takes none, or any of poses, forces, frames and events");
}

void choose_formats(const std::string& text, reports::RawChoice& choice) {
  const std::pair<std::string_view, bool*> words[] = {{"sqlite", &choice.sqlite},
                                                      {"slicer", &choice.slicer},
                                                      {"xapi", &choice.xapi},
                                                      {"motion-bids", &choice.motion_bids}};
  choose(text, words, "--also takes any of sqlite, slicer, xapi and motion-bids");
}

int run_export(const Arguments& arguments) {
  const std::string out = arguments.required("--out");
  reports::RawChoice choice;
  if (arguments.has("--raw")) choose_raw(arguments.text("--raw"), choice);
  if (arguments.has("--also")) choose_formats(arguments.text("--also"), choice);
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (arguments.has("--case")) choice.case_id = arguments.text("--case");
  if (arguments.has("--study")) {
    const auto study = casedb::find_study(*library, arguments.text("--study"));
    if (!study) return refuse(study.error());
    choice.study_id = study->study_id;
  }
  if (!library->actor().is_operator() || arguments.has("--by")) {
    // Of a study that is somebody's own; consent is asked of each person.
    if (!choice.study_id) throw UsageError("--by needs --study");
    casedb::Relation relation;
    relation.own_study = library->actor().person_id &&
                         casedb::is_researcher_of(*library, *choice.study_id, *library->actor().person_id);
    if (const auto by = acting(*library, arguments, casedb::Action::export_study, relation); !by)
      return refuse(by.error());
  }
  const bool draft = choice.study_id && casedb::has_draft(*library, *choice.study_id);
  const auto& whose = library->actor().person_id;
  if (draft && whose && casedb::is_researcher_of(*library, *choice.study_id, *whose))
    return refuse({"blinded", "until the plan is frozen nobody who works on the study may see outcomes by person"});
  const std::string key_file = arguments.text("--key");
  choice.exact = choice.study_id.has_value() && !key_file.empty();
  const bool key_is_new = !key_file.empty() && !std::filesystem::exists(key_file);
  auto key = key_from_file(key_file);
  if (!key) return refuse(error_of("--key", key_file, key.error()));
  const auto done = reports::export_raw(*library, out, choice, *key);
  key->fill(std::byte{0});
  if (!done) {
    if (key_is_new) std::filesystem::remove(key_file);  // refused: nothing is changed
    return refuse(error_of("--out", out, done.error()));
  }
  try {
    casedb::audit_alone(*library, casedb::Act::export_attempts,
                        choice.study_id ? casedb::Object{"study", *choice.study_id} : casedb::Object{});
    if (choice.study_id && casedb::has_plan(*library, *choice.study_id)) {
      // The export has all simulated people there are; a study of real ones has none of them.
      const auto plan = casedb::find_plan(*library, *choice.study_id);
      const bool of_simulated = plan && plan->plan.people == assessment::study::People::simulated;
      casedb::note_look(*library, *choice.study_id, draft ? "export before the freeze" : "export",
                        of_simulated ? done->simulated_people : done->people - done->simulated_people);
    }
  } catch (...) {
    std::filesystem::remove_all(out);  // nothing leaves unnoted
    throw;
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_export(*done).c_str(), stdout);
    return kDone;
  }
  std::printf("%zu attempts (%zu of simulated operators) of %zu people, %zu values, %zu files\n", done->attempts,
              done->synthetic, done->people, done->metrics, done->files);
  if (!choice.exact && done->attempts > done->synthetic)
    std::puts(
        "Numbers of people's attempts are rounded to two significant digits, and their recordings are left out: "
        "--study with --key writes both in full.");
  return kDone;
}

constexpr Option kExportOptions[] = {
    kLibrary,
    {"--out", "DIR", "the new folder"},
    {"--case", "CASE", "only attempts on this case; default: every attempt"},
    {"--study", "STUDY",
     "attempts of people who consent to it; default: of people who consent to research with this library"},
    {"--raw", "poses,forces,frames,events|none", "which parts of the recordings; default all"},
    {"--also", "sqlite,slicer,xapi,motion-bids",
     "the same in other formats, into the same folder: one SQLite file, 3D Slicer's markups and transforms, xAPI "
     "statements, a Motion-BIDS data set"},
    {"--key", "FILE",
     "gives people, attempts and cases the same names as in other exports with this key; created if there is none. "
     "Keep it apart from what you pass on. With --study people's numbers are exact and their recordings are "
     "included"},
    kJson};

}  // namespace

Command export_command() {
  return {.name = "export",
          .options = kExportOptions,
          .acts = true,
          .summary =
              "Writes the attempts of people who consent, and simulated ones, as CSV with a data dictionary into a "
              "new folder: no names, no dates (docs/export.md).",
          .run = &run_export};
}

}  // namespace seldinger::app
