// A library as a large site has one: 500 trainees in 20 cohorts of five programmes, and what they have done in half
// a year, stored by the product's own writers. Made once for a build.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seldinger::load {

constexpr int kTrainees = 500, kProgrammes = 5, kCohorts = 20;
constexpr int kLearners = kTrainees / kCohorts;  // of a cohort
inline const std::string kPassword = "a long password";

std::string trainee_name(int number);   // "trainee 007"; of cohort number % kCohorts
std::string mentor_name(int cohort);    // "mentor 07"
std::string director_name(int number);  // "director 3"; of every fifth cohort

// Copies it to `folder`, where nothing may be. With `attempts` of them in all.
void load_library(const std::filesystem::path& folder, int attempts);

}  // namespace seldinger::load
