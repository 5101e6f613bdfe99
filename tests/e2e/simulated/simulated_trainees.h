// A library of the graded cases of the built-in patients, for simulated trainees.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/process.h"

namespace seldinger {

class SimulatedTrainees : public testing::Test {
 protected:
  // In a folder of this name.
  static void make(const std::string& folder) {
    scratch_ = fixtures::fresh_folder(folder);
    library_ = (scratch_ / "library").string();
    const nlohmann::json made = fixtures::demo_library("--cases", library_);
    cases_ = made.at("cases");
  }
  static nlohmann::json ask(const std::string& words) {
    const auto ran = fixtures::run(fixtures::kProgram + " " + words + " --json --library " + library_, scratch_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return nlohmann::json::parse(ran.out, nullptr, false);
  }
  static std::string first_case() { return cases_[0].at("case_id"); }
  // Where it is the same whichever: an attempt of this patient, who does not breathe, takes a tenth of the first's.
  static std::string quick_case() { return cases_[2].at("case_id"); }
  static inline std::filesystem::path scratch_;
  static inline std::string library_;
  static inline nlohmann::json cases_;
};

}  // namespace seldinger
