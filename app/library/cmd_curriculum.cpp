// curriculum add, item, publish, list, show, remove.
#include <charconv>
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/library/curriculum_json.h"
#include "casedb/people/people.h"
#include "reports/pages/curricula_page.h"

namespace seldinger::app {
namespace {

// "2" or "2:proficient".
assessment::Gate gate_from(const std::string& text) {
  assessment::Gate gate;
  const std::size_t colon = text.find(':');
  const std::string number = text.substr(0, colon);
  std::size_t item = 0;
  const auto read = std::from_chars(number.data(), number.data() + number.size(), item);
  const auto reached = assessment::proficiency_from(colon == text.npos ? "passed" : text.substr(colon + 1));
  if (read.ec != std::errc() || read.ptr != number.data() + number.size() || item < 1 || !reached ||
      *reached < assessment::Proficiency::passed)
    throw UsageError("--after is an item's number, or N:passed or N:proficient");
  gate.after = item - 1;
  gate.reached = *reached;
  return gate;
}

int run_curriculum_add(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto made = casedb::add_curriculum(*library, arguments.positional(0), by);
  if (!made) return refuse_act(*library, casedb::Act::make_curriculum, made.error());
  std::fputs(arguments.has("--json") ? json_of_curriculum_id(*made).c_str() : (*made + "\n").c_str(), stdout);
  return kDone;
}

int run_curriculum_item(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  arguments.required("--case");
  std::vector<assessment::Gate> gates;
  if (arguments.has("--after"))
    for (const std::string& text : arguments.all("--after")) gates.push_back(gate_from(text));
  std::optional<int> limit;
  if (arguments.has("--attempt-limit")) limit = static_cast<int>(arguments.whole("--attempt-limit", 1, 1, 1000));
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto number =
      casedb::add_curriculum_item(*library, arguments.positional(0), arguments.text("--case"), limit, gates, by);
  if (!number) return refuse_act(*library, casedb::Act::change_curriculum, number.error());
  if (arguments.has("--json"))
    std::fputs(json_of_curriculum_item(*number).c_str(), stdout);
  else
    std::printf("item %d\n", *number);
  return kDone;
}

int run_curriculum_publish(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto done = casedb::publish_curriculum(*library, arguments.positional(0), by);
  return done ? kDone : refuse_act(*library, casedb::Act::publish_curriculum, done.error());
}

int run_curriculum_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto curricula = casedb::list_curricula(*library);
  if (arguments.has("--json")) {
    std::fputs(json_of_curricula(curricula).c_str(), stdout);
    return kDone;
  }
  if (curricula.empty()) std::puts("There are no curricula yet; `seldinger curriculum add` makes one.");
  for (const casedb::Curriculum& one : curricula)
    std::printf("%s  %-10s %zu items  %s\n", one.curriculum_id.c_str(), casedb::name_of(one.state).c_str(),
                one.items.size(), one.title.c_str());
  return kDone;
}

int run_curriculum_show(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto curriculum = casedb::find_curriculum(*library, arguments.positional(0));
  if (!curriculum) return refuse(curriculum.error());
  std::optional<std::string> person_id;
  if (arguments.has("--user")) {
    for (const casedb::Account& one : casedb::list_users(*library))
      if (one.login_name == arguments.text("--user")) person_id = one.person_id;
    if (!person_id) return refuse({"no_user", "there is no such user"});
  }
  const auto items =
      person_id ? casedb::states_of(*library, *curriculum, *person_id) : casedb::states_of(*library, *curriculum);
  if (arguments.has("--json")) {
    std::fputs(json_of_curriculum(*curriculum, items, person_id.has_value()).c_str(), stdout);
    return kDone;
  }
  std::printf("%s, %s\n", curriculum->title.c_str(), casedb::name_of(curriculum->state).c_str());
  for (std::size_t i = 0; i < items.size(); ++i) {
    const casedb::ItemState& item = items[i];
    std::string line = std::to_string(i + 1) + ". " + item.title;
    if (item.case_id.empty())
      line += ", no version is published";
    else
      line += ", version " + std::to_string(item.version);
    if (const std::string gates = reports::gates_text(curriculum->items[i].gates); !gates.empty())
      line += ", " + gates;
    if (person_id) {
      line += ": " + reports::proficiency_text(item.progress.reached) + ", " + std::to_string(item.passes) +
              " of " + std::to_string(item.attempts) + " attempts passed";
      if (!item.progress.open) line += ", not open yet";
      if (item.progress.due) line += ", due";
    }
    if (item.progress.attempts_left) line += ", " + std::to_string(*item.progress.attempts_left) + " attempts left";
    std::puts(line.c_str());
  }
  return kDone;
}

int run_curriculum_remove(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto done = casedb::remove_curriculum(*library, arguments.positional(0), by);
  return done ? kDone : refuse_act(*library, casedb::Act::remove_curriculum, done.error());
}

constexpr Option kCurriculumItemOptions[] = {
    kLibrary,
    {"--case", "CASE", "a published case; the item always means its published version"},
    {"--attempt-limit", "N", "attempts per trainee; default the case's own limit"},
    {"--after", "N[:passed|:proficient]", "opens once item N is passed or proficient; default passed", true},
    kJson};

constexpr Option kCurriculumShowOptions[] = {kLibrary, {"--user", "NAME", "show this person's progress"}, kJson};

}  // namespace

Command curriculum_add_command() {
  return {.name = "curriculum add",
          .positionals = "TITLE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .named = true,
          .summary = "Makes a curriculum, as a draft; by a mentor.",
          .run = &run_curriculum_add};
}

Command curriculum_item_command() {
  return {.name = "curriculum item",
          .positionals = "CURRICULUM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCurriculumItemOptions,
          .acts = true,
          .named = true,
          .summary = "Adds a case to the end of a draft; by a mentor.",
          .run = &run_curriculum_item};
}

Command curriculum_publish_command() {
  return {.name = "curriculum publish",
          .positionals = "CURRICULUM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .named = true,
          .summary = "Publishes a curriculum; by a director. It never changes again.",
          .run = &run_curriculum_publish};
}

Command curriculum_list_command() {
  return {.name = "curriculum list",
          .options = kLibraryJson,
          .summary = "Lists the curricula, oldest first.",
          .run = &run_curriculum_list};
}

Command curriculum_show_command() {
  return {.name = "curriculum show",
          .positionals = "CURRICULUM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCurriculumShowOptions,
          .summary = "Shows a curriculum's items; with --user what that person has reached and which item is due.",
          .run = &run_curriculum_show};
}

Command curriculum_remove_command() {
  return {.name = "curriculum remove",
          .positionals = "CURRICULUM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .named = true,
          .summary = "Deletes a draft (by a mentor) or retires a published curriculum (by a director).",
          .run = &run_curriculum_remove};
}

}  // namespace seldinger::app
