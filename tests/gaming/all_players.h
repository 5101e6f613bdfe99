// Every player at every case of a library that `demo --cases` made: who passes, and what fails those who do not.
#pragma once

#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "assessment/grading/grade.h"
#include "assessment/score.h"
#include "casedb/cases/cases.h"
#include "casedb/database/library.h"
#include "session/case/task.h"
#include "tests/fixtures/command_library.h"
#include "tests/gaming/player.h"

namespace seldinger::gaming {

struct Played {
  std::string title;
  const Player* player = nullptr;
  assessment::Grade grade;
};

inline assessment::Grade grade_of(const Player& player, const session::Task& task) {
  const auto scored = assessment::score(task.scene, play(player, task.scene, task.plan));
  if (!scored) {
    ADD_FAILURE() << task.row.title << ", " << player.name << ": " << scored.error().text;
    return {};
  }
  return assessment::grade(task.row.rule, {.metrics = scored->metrics, .cut_off = {}, .time_limit_s = {}});
}

// The first criterion that is not met, and by how much.
inline std::string failing(const assessment::Grade& grade) {
  if (!grade.reason.empty()) return grade.reason;
  for (const assessment::CriterionResult& one : grade.criteria)
    if (one.outcome != assessment::Outcome::met) {
      char value[32];
      std::snprintf(value, sizeof value, "%.3g", one.value.value_or(0.0));
      return assessment::text_of(one.criterion) + ": " + (one.value ? value : one.reason);
    }
  return "PASSES";
}

// The honest one first: that nobody passes would mean nothing if he did not.
inline std::vector<Played> all_played(casedb::Library& library) {
  std::vector<Played> all;
  for (const casedb::CaseRow& row : casedb::list_cases(library)) {
    const auto task = session::prepare_task(library, row.case_id, {});
    if (!task) {
      ADD_FAILURE() << row.title << ": " << task.error().text;
      continue;
    }
    all.push_back({row.title, &honest_player(), grade_of(honest_player(), *task)});
    for (const Player& player : gaming_players()) all.push_back({row.title, &player, grade_of(player, *task)});
  }
  return all;
}

inline void expect_only_honest_passes(const std::vector<Played>& all) {
  ASSERT_FALSE(all.empty());
  for (const Played& one : all) {
    const bool honest = one.player == &honest_player(), passed = one.grade.verdict == assessment::Verdict::passed;
    std::printf("%-50s %-20s %s\n", one.title.c_str(), one.player->name, failing(one.grade).c_str());
    // What is to be deferred is passed by nobody who punctures.
    const bool to_defer = one.title.find("INR") != std::string::npos;
    EXPECT_EQ(passed, honest && !to_defer)
        << one.title << ", who " << one.player->name << " (" << one.player->fault << "): " << failing(one.grade);
  }
}

}  // namespace seldinger::gaming
