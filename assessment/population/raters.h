// What others say of a simulated person: raters of a global rating scale with their severity, halo and drift, and
// the answers that the person gives to a questionnaire. Planted, so that reliability and rater models have an
// oracle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "assessment/population/person.h"

namespace seldinger::assessment::population {

struct Rater {
  double severity = 0.0;  // points taken from every rating
  double halo = 0.0;      // 0 to 1: how much of an item's rating is the rater's impression of the whole
  double drift = 0.0;     // points taken more, from a rater's first rating to the hundredth
  double error_sd = 0.5;
  std::uint64_t key = 0;
};
Rater drawn_rater(std::uint64_t seed, std::uint64_t number);

// The items of a global rating scale of interventional skill and the abilities that each is about, on 1 to 5.
struct RatedItem {
  std::string_view name;
  Abilities weight;  // sums to 1
};
std::span<const RatedItem> rated_items();
// Of an ability as it was on the occasion; `order`: how many ratings the rater gave before.
int rating_of(const Rater& rater, const Person& person, const Abilities& ability, std::size_t item,
              std::uint64_t order);
// Of an item of any form by its words: as the rated item whose name it begins with, else of all abilities alike. Of
// `points` points the place, from 0.
std::size_t rated_point(const Rater& rater, const Person& person, const Abilities& ability, std::string_view words,
                        std::uint64_t order, std::size_t points);

// The statements of the final evaluation's questionnaire with the published mean and standard deviation of trainees
// and experts (Vidal, thesis, Bangor University 2008, table 6.3), on 1 to 5.
struct Statement {
  std::string_view words;
  double trainee_mean, trainee_sd, expert_mean, expert_sd;
};
std::span<const Statement> statements();
// A person's answers hang together: who likes one thing likes the others too. Experts are people of seven years in
// radiology and more.
int answer_of(const Person& person, std::size_t statement);
// To an item of any form by its words: the place among `points` points, from 0. Of a statement above that of its
// answer; to others each point is as likely as the next, and who likes one thing likes the others, too.
std::size_t answered_point(const Person& person, std::string_view words, std::size_t points);

}  // namespace seldinger::assessment::population
