// A library that is made in a moment and practised quickly, since everything is ten times slower where races are
// looked for: a ball of soft tissue, once for each modality, and a mentor who may practise it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "casedb/cases/cases.h"
#include "casedb/cases/versions.h"
#include "casedb/people/people.h"
#include "session/case/case_check.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::fixtures {

inline constexpr const char* kBallPassword = "a long password";  // of "mona"
inline constexpr double kBallDepthMm = 25.0;

// Case ids, in the order of the modalities. The folder must not exist.
inline std::vector<std::string> make_ball_library(const std::filesystem::path& folder,
                                                  const std::vector<cases::Modality>& modalities) {
  casedb::Library library = std::move(casedb::Library::open_or_create(folder).value());
  EXPECT_TRUE(casedb::add_user(library, "mona", casedb::Role::mentor, kBallPassword));
  make_cohort(library, "mona", {});
  std::vector<std::string> ids;
  for (const cases::Modality modality : modalities) {
    casedb::NewCase made = new_ball();
    made.modality = modality;
    made.instrument.kind = cases::InstrumentKind::core;
    ids.push_back(casedb::add_case(library, made));
    EXPECT_TRUE(casedb::add_lesion(library, ids.back(), ball_target(kBallDepthMm)));
    const auto published =
        casedb::publish_case(library, ids.back(), session::check_case(library, ids.back()).value(), "mona", true);
    EXPECT_TRUE(published) << published.error().text;
  }
  return ids;
}

}  // namespace seldinger::fixtures
