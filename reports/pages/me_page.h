// What somebody is asked about themselves: to which research they consent, the facts by which studies compare
// people, and the deletion of what they recorded.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

struct AboutMe {
  std::vector<casedb::FactGiven> facts;  // oldest first
  std::vector<casedb::Consent> consents;
};

// What came of the last answer: what was wrong with it, or what was done; empty: nothing. `typed`: facts that were
// refused, by their ids, so that nobody types them again.
struct Told {
  std::string problem{}, done{};
  std::map<std::string, std::string> typed{};
};

// Its forms go to /me/consent, /me/facts and /me/erase.
std::string me_page(const Visitor& visitor, const AboutMe& about, const Told& told);

}  // namespace seldinger::reports
