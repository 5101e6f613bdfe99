// What was published about how people of different experience differ at simulators of image-guided puncture and
// their kin: the figures that simulated people are held against. Each row says of how many people it is and whether
// it was reported because it was significant, since what is chosen so is too large (Hedges, J. Educ. Stat. 9, 1984,
// 61).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "assessment/statistics/answer.h"

namespace seldinger::assessment::population {

enum class EffectKind {
  difference,      // of two groups in pooled standard deviations, the more experienced minus the less
  discriminating,  // of so many metrics so many told groups apart at p < .05
  ratio,           // after practice to before, or with help to without
  level,           // a share or a rate of people like novices
};

struct ReferenceEffect {
  std::string_view source;  // as it is cited
  std::string_view what;
  EffectKind kind = EffectKind::difference;
  double value = 0.0;  // of `discriminating` the share
  // People of less and of more experience; n2 0: n1 people in all; both 0: not reported in what was read.
  std::size_t n1 = 0, n2 = 0;
  std::size_t of = 0;            // of `discriminating`: of how many metrics
  bool selected = false;         // reported because it was significant
  bool fitted = false;           // the population was set by it; the others are predicted
  std::string_view how;          // the value was had from the publication's figures
  int statement = -1;            // of a questionnaire: which of statements() asks the same; -1: none
  bool of_answers = false;       // to a questionnaire
  bool of_two = false;           // of a person's first two performances, here their mean
  std::string_view metric = {};  // of a ratio or a level: ours of the same thing; empty: there is none
  double error = 0.0;            // of a ratio or a level: its standard error; 0: not reported, nor to be had
};
std::span<const ReferenceEffect> reference_effects();

// Of two independent groups: d from t, and its standard error (Hedges and Olkin 1985).
double difference_of_t(double t, std::size_t n1, std::size_t n2);
double difference_error(double d, std::size_t n1, std::size_t n2);
double share_error(double share, std::size_t of);
// Of a difference and a share by their sizes; of the others as the row has it.
std::optional<double> standard_error(const ReferenceEffect& effect);
std::optional<statistics::Interval> interval95(const ReferenceEffect& effect);  // of those with a standard error

// The likeliest true difference of one that was reported since it was significant at 5 %, two-sided: the maximum of
// the likelihood given that it was (Hedges 1984).
double unselected(double d, std::size_t n1, std::size_t n2);

// Of two groups with that true difference: how often it becomes significant, and how large it then looks.
struct Selected {
  double power = 0.0, mean_size = 0.0;  // of |d| among the significant ones
};
Selected selected_of(double true_difference, std::size_t n1, std::size_t n2);

}  // namespace seldinger::assessment::population
