// Collects every reason against a source, so that a user sees all of them at once.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::casedb {

class Problems {
 public:
  void add(std::string code, std::string text) {
    if (list_.size() < kMost)
      list_.push_back({std::move(code), std::move(text)});
    else if (list_.size() == kMost)
      list_.push_back({"more", "there are further problems that are not listed"});
  }
  void add(const base::Error& error) {
    add(error.code, error.text);
    for (const base::Problem& finding : error.findings) add(finding.code, finding.text);
  }
  bool empty() const noexcept { return list_.empty(); }
  base::Error error() const {  // the first is the error, the rest are findings
    CHECK(!list_.empty());
    return {list_.front().code, list_.front().text, {list_.begin() + 1, list_.end()}};
  }

 private:
  static constexpr std::size_t kMost = 40;  // a folder of broken slices says no more after that
  std::vector<base::Problem> list_;
};

}  // namespace seldinger::casedb
