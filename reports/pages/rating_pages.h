// The raters' bench: the key, the replays by their numbers, and a replay beside the form. Nothing on them tells
// whose a replay is; numbers count in the rater's own order.
#pragma once

#include <map>
#include <string>

#include "casedb/ratings/rating_rounds.h"

namespace seldinger::reports {

std::string rating_start_page(const std::string& token, const std::string& problem);
std::string rating_bench_page(const casedb::RatingBench& bench);

struct RatingView {
  std::string token;
  const casedb::RatingPage* page = nullptr;
  std::map<std::string, std::string> typed;     // by item, what was refused
  std::map<std::string, std::string> problems;  // by item
};
std::string rating_page(const RatingView& view);

}  // namespace seldinger::reports
