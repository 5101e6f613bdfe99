#include "reports/studies/numbers/subgroups.h"

#include <algorithm>
#include <set>

#include "assessment/statistics/relations/proportions.h"
#include "casedb/people/cohorts.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
namespace statistics = assessment::statistics;

const casedb::Background& background_of(const std::map<std::string, casedb::Background>& all,
                                        const std::string& name) {
  static const casedb::Background kNone;
  const auto found = all.find(name);
  return found == all.end() ? kNone : found->second;
}

std::string one_word(const std::set<std::string>& words) {
  return words.empty() ? "unknown" : words.size() > 1 ? "several" : *words.begin();
}

struct Parting {
  const char* words;
  std::set<std::string> (*of)(const study::PersonValue&, const casedb::Background&);
};
constexpr Parting kPartings[] = {
    {"Needle led by", [](const study::PersonValue& person, const casedb::Background&) { return person.hands; }},
    {"Arm", [](const study::PersonValue& person, const casedb::Background&) { return person.arms; }},
    {"Writing hand",
     [](const study::PersonValue&, const casedb::Background& background) {
       const auto found = background.answers.find("handedness");
       return found == background.answers.end() ? std::set<std::string>() : std::set<std::string>{found->second};
     }},
    {"Site",
     [](const study::PersonValue&, const casedb::Background& background) {
       return std::set<std::string>(background.sites.begin(), background.sites.end());
     }},
};

// What is withheld is of enough persons, and of two subgroups: else the sum of all would tell it.
void withhold(std::vector<Subgroup>& largest_first) {
  std::int64_t persons = 0;
  int groups = 0;
  for (auto one = largest_first.rbegin(); one != largest_first.rend(); ++one) {
    if (one->n() >= casedb::kSmallestCell && (groups == 0 || (groups > 1 && persons >= casedb::kSmallestCell)))
      break;
    one->told = false;
    persons += one->n();
    ++groups;
  }
}

}  // namespace

std::int64_t Subgroup::passes() const {
  return std::count(passed.begin(), passed.end(), true);
}

std::vector<Subgroups> subgroups_of(const study::Compared& outcome, const PassMark& mark,
                                    const std::map<std::string, casedb::Background>& backgrounds) {
  std::vector<Subgroups> all;
  for (const Parting& parting : kPartings) {
    std::map<std::string, std::vector<bool>> found;
    for (const study::PersonValue& person : outcome.people)
      if (person.standing != study::Standing::absent)
        found[one_word(parting.of(person, background_of(backgrounds, person.name)))].push_back(
            is_at_mark(person, mark));
    if (found.size() < 2) continue;
    Subgroups& made = all.emplace_back(Subgroups{parting.words, {}});
    for (auto& [name, passed] : found) made.groups.push_back({name, std::move(passed)});
    std::stable_sort(made.groups.begin(), made.groups.end(),
                     [](const Subgroup& a, const Subgroup& b) { return a.n() > b.n(); });
    withhold(made.groups);
    const Subgroup& largest = made.groups.front();
    const auto is_small = [](const Subgroup& one) {
      return std::min(one.passes(), one.n() - one.passes()) < kDescriptiveBelow;
    };
    for (Subgroup& one : made.groups) {
      if (!one.told) continue;
      one.share = statistics::wilson_interval(one.passes(), one.n());
      if (&one == &largest) continue;
      one.difference = statistics::newcombe_interval(one.passes(), one.n(), largest.passes(), largest.n());
      one.descriptive = is_small(one) || is_small(largest);
    }
  }
  return all;
}

}  // namespace seldinger::reports
