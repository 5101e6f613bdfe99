#include "casedb/ratings/rated_people.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

std::vector<RatedPeople> rated_people(Library& library, const std::string& study_id) {
  const Snapshot snapshot(library.database());
  std::map<std::string, std::pair<std::string, std::string>> views;  // case and pseudonym
  Statement rows = question(library.database(), "rated_views_of_study");
  for (rows.bind("study_id", study_id); rows.step();)
    views.emplace(rows.text("view_id"), std::pair(rows.text("case_id"), rows.text("pseudonym")));
  struct Sum {
    double sum = 0.0;
    std::size_t n = 0;
    double mean() const { return sum / static_cast<double>(n); }
  };
  struct Found {
    std::map<std::string, std::map<std::string, Sum>> people;  // and their replays
    std::vector<assessment::rating::Rating> scores;
    std::size_t each = 0;
  };
  std::map<std::tuple<std::string, int, std::string>, Found> found;
  std::map<std::pair<std::string, int>, std::string> titles;
  for (const Round& round : list_rounds(library)) {
    if (!round.rated || round.study_id != study_id) continue;
    const auto ratings = list_ratings(library, round.code);
    if (!ratings) continue;  // damage, which the library's check tells
    titles[{round.form_id, round.version}] = ratings->form.form.title;
    for (const assessment::rating::Rating& one : scores_of(*ratings, "")) {
      const auto view = views.find(one.view);
      if (one.part != assessment::rating::Part::rated || view == views.end()) continue;
      const auto& [case_id, pseudonym] = view->second;
      Found& here = found[{round.form_id, round.version, case_id}];
      here.scores.push_back(one);
      here.each = here.each == 0 ? ratings->each : std::min(here.each, ratings->each);
      Sum& of = here.people[pseudonym][one.view];
      of.sum += one.score;
      ++of.n;
    }
  }
  std::vector<RatedPeople> all;
  for (auto& [key, here] : found) {
    const auto& [form_id, version, case_id] = key;
    RatedPeople& rated = all.emplace_back();
    rated.form_id = form_id;
    rated.form_title = titles[{form_id, version}];
    rated.version = version;
    rated.case_id = case_id;
    rated.scores = std::move(here.scores);
    rated.each = here.each;
    for (const auto& [pseudonym, replays] : here.people) {
      Sum over;
      for (const auto& [view_id, replay] : replays) {
        over.sum += replay.mean();
        ++over.n;
        rated.ratings += replay.n;
      }
      rated.mean.emplace(pseudonym, over.mean());
    }
  }
  return all;
}

std::vector<RatedRound> rated_rounds(Library& library, const std::string& study_id) {
  const Snapshot snapshot(library.database());
  std::vector<RatedRound> all;
  for (const Round& round : list_rounds(library)) {
    if (!round.rated || round.study_id != study_id) continue;
    const auto ratings = list_ratings(library, round.code);
    if (!ratings) continue;  // damage, which the library's check tells
    RatedRound one{ratings->form.form.title, round.title,  round.version, {},
                   scores_of(*ratings, ""),  ratings->each};
    one.agreement = assessment::rating::agreement_of(one.scores, one.each);
    if (one.agreement.ratings > 0) all.push_back(std::move(one));
  }
  std::reverse(all.begin(), all.end());
  return all;
}

}  // namespace seldinger::casedb
