// What somebody is asked about themselves: to which research they consent, the facts by which studies compare
// people, and the deletion of what they recorded.
#pragma once

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

// `problem`: what was wrong with the last answer; empty: nothing. Its forms go to /me/consent, /me/facts and
// /me/erase.
std::string me_page(const Visitor& visitor, const AboutMe& about, std::string_view problem);

}  // namespace seldinger::reports
