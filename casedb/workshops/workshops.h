// A workshop's day: people of a study come, consent at the door, get a number, and go through all stations, each in
// an order of their own (assessment/study/stations.h). What they have done there is asked of their attempts, and
// ticked where a station has no case.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct WorkshopStation {
  std::string title;
  std::optional<std::string> case_id{};  // none: it is ticked
};

struct NewWorkshop {
  std::string study_id, title;
  std::vector<WorkshopStation> stations;
  std::vector<std::string> groups{};  // each fills squares of its own; none: all are one
};

struct Workshop : NewWorkshop {
  std::string workshop_id, code;
  std::int64_t seed = 0, opened_us = 0;
  std::optional<std::int64_t> closed_us{};
  bool is_open() const noexcept { return !closed_us.has_value(); }
};

inline constexpr std::size_t kLeastStations = 2, kMostStations = 12;

// `bad_title`, `bad_stations` (not two to twelve of different titles), `bad_group`, `no_study`, `no_case`,
// `real_person` (the study's plan is of simulated people).
base::Result<Workshop> open_workshop(Library& library, const NewWorkshop& made);
// By its code, however typed: `no_workshop`.
base::Result<Workshop> find_workshop(Library& library, std::string_view code);
std::vector<Workshop> list_workshops(Library& library);  // newest first
// Nobody comes any more: `workshop_closed`.
base::Result<void> close_workshop(Library& library, const Workshop& workshop);

// Somebody who came, as the board knows them.
struct Participant {
  int number = 0;
  std::string person_id, pseudonym, group;
  std::int64_t came_us = 0;
  std::vector<std::size_t> order;  // of the stations, by their places
  std::vector<bool> done;          // by the place of the station
  // The first in their order that is not done; none: all are.
  std::optional<std::size_t> next() const;
};

// Whoever comes to the door. `consents_now`: they have just signed the study's newest text, which is stored with
// them; else their consent stands already. Nothing is kept of whom is refused: `workshop_closed`, `bad_group`,
// `no_person`, `no_text` (the study asks for no consent), `no_consent`, `real_person` (its plan is of simulated
// people), `already_admitted`.
base::Result<Participant> admit_to_workshop(Library& library, const Workshop& workshop,
                                            const std::string& person_id, const std::string& group,
                                            bool consents_now);
// A station without a case is done: `no_participant`, `no_station` (there is none of that title, or an attempt
// tells).
base::Result<void> tick_in_workshop(Library& library, const Workshop& workshop, int number,
                                    const std::string& station);

// Everybody who came and whose consent stands, by number. An attempt counts from when they came.
std::vector<Participant> list_participants(Library& library, const Workshop& workshop);

}  // namespace seldinger::casedb
