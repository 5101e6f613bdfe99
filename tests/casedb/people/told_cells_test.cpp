// What is told of cohorts to who does not see their people, and the attack by differences on it: everybody who may
// read it together, in successive weeks, with all that they see elsewhere.
#include "casedb/people/told_cells.h"

#include <array>
#include <random>
#include <set>
#include <tuple>

#include "casedb/attempts/attempts.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

constexpr std::int64_t kStart_us = 1'767'571'200'000'000;  // Monday, 2026-01-05
constexpr std::int64_t kHour_us = 3'600'000'000;

std::int64_t in_week(int week, int hour = 1) {
  return kStart_us + week * kWeek_us + hour * kHour_us;
}
// When the week before is told.
std::int64_t told_at(int week) {
  return kStart_us + week * kWeek_us + kToldAfter_us;
}

CohortPast cohort_of(const std::string& id, const std::string& programme, int first, int count) {
  CohortPast past{id, programme, {}};
  for (int i = first; i < first + count; ++i)
    past.deeds.push_back({"p" + std::to_string(i), in_week(0), Deed::came});
  return past;
}
void all_do(CohortPast& past, int week, Deed what, int first, int count) {
  for (int i = first; i < first + count; ++i)
    past.deeds.push_back({"p" + std::to_string(i), in_week(week, 2), what});
}
CohortCells cells(const std::vector<CohortPast>& pasts, const std::string& id, int week) {
  return told_cells(pasts, told_at(week)).at(id).cells;
}

TEST(ToldCells, FivePeopleMakeACountFourDoNot) {
  for (const int people : {4, 5}) {
    std::vector<CohortPast> pasts{cohort_of("a", "R", 0, people)};
    all_do(pasts[0], 0, Deed::hit, 0, people);
    all_do(pasts[0], 0, Deed::miss, 0, people);
    const bool told = people == 5;
    EXPECT_EQ(cells(pasts, "a", 1), told ? (CohortCells{5, 10, 10, 5}) : (CohortCells{-1, -1, -1, -1}));
    EXPECT_EQ(cells(pasts, "a", 0), (CohortCells{-1, -1, -1, -1})) << "the week is not over";
    EXPECT_EQ(told_cells(pasts, told_at(1) - 1).at("a").cells.learners, -1) << "nor stored";
  }
}

TEST(ToldCells, WhatFollowsBySubtractionIsACountToo) {
  // Six made attempts; whose hit is unknown is one: the attempts are told, "of how many" is not.
  std::vector<CohortPast> pasts{cohort_of("a", "R", 0, 6)};
  all_do(pasts[0], 0, Deed::hit, 0, 6);
  all_do(pasts[0], 0, Deed::unknown, 0, 1);
  EXPECT_EQ(cells(pasts, "a", 1), (CohortCells{6, 7, -1, -1}));
  // One missed: so does who hit everything else.
  pasts = {cohort_of("a", "R", 0, 6)};
  all_do(pasts[0], 0, Deed::hit, 0, 6);
  all_do(pasts[0], 0, Deed::miss, 3, 1);
  EXPECT_EQ(cells(pasts, "a", 1), (CohortCells{6, 7, -1, -1}));
}

TEST(ToldCells, AWeekInWhichFewDidSomethingIsToldWithALaterOne) {
  std::vector<CohortPast> pasts{cohort_of("a", "R", 0, 8)};
  all_do(pasts[0], 0, Deed::hit, 0, 8);
  all_do(pasts[0], 1, Deed::miss, 0, 1);
  all_do(pasts[0], 2, Deed::miss, 1, 4);
  EXPECT_EQ(cells(pasts, "a", 1), (CohortCells{8, 8, 8, 8}));
  EXPECT_EQ(cells(pasts, "a", 2), (CohortCells{8, 8, 8, 8})) << "one person's miss";
  EXPECT_EQ(cells(pasts, "a", 3), (CohortCells{8, 13, 13, 8}));
  const ToldCells told = told_cells(pasts, told_at(2)).at("a");
  EXPECT_EQ(told.attempts_us, kStart_us + kWeek_us) << "and says of which week it tells";
  // Who leaves and comes is told when five have.
  pasts[0].deeds.push_back({"p0", in_week(3), Deed::left});
  EXPECT_EQ(cells(pasts, "a", 4).learners, 8);
}

TEST(ToldCells, WhoIsSeenElsewhereIsNotAmongTheFive) {
  // Nine in Surgery, of whom four are learners in Radiology too: its director subtracts them.
  for (const int others : {4, 5}) {
    std::vector<CohortPast> pasts{cohort_of("a", "S", 0, 4 + others), cohort_of("b", "R", 0, 4)};
    all_do(pasts[0], 0, Deed::hit, 0, 4 + others);
    EXPECT_EQ(cells(pasts, "a", 1).attempts, others == 5 ? 9 : -1);
    EXPECT_EQ(cells(pasts, "b", 1).learners, -1);
  }
}

TEST(ToldCells, TwoCohortsOfTheSamePeopleTellNoDifference) {
  std::vector<CohortPast> pasts{cohort_of("a", "R", 0, 6), cohort_of("b", "R", 0, 7)};
  for (CohortPast& past : pasts) all_do(past, 0, Deed::hit, 0, past.deeds.size() == 6 ? 6 : 7);
  EXPECT_EQ(cells(pasts, "a", 1).attempts, 6);
  EXPECT_EQ(cells(pasts, "b", 1).attempts, -1) << "7 - 6 is the seventh's";
}

// The attack. Who reads may be every director but those of the cohort's own programme; together they see by name
// whoever is a learner in one of theirs. What they derive is any difference of two counts of one kind, told in any
// week of any cohort, less what they see by name. It is a leak when one to four people are left in it.
struct Attack {
  std::vector<CohortPast> pasts;
  std::vector<std::map<std::string, ToldCells>> weeks;
  int leaks = 0, looked_at = 0, wrong = 0;

  // A count is 0, the learners, or a set of kinds of attempts: 1 of unknown hit, 2 missed, 4 hit.
  static int share(const CohortPast& past, const std::string& who, unsigned count, std::int64_t until_us) {
    std::map<std::int64_t, bool> in;
    int attempts = 0;
    for (const CohortDeed& deed : past.deeds) {
      if (deed.person_id != who || deed.at_us >= until_us) continue;
      if (deed.what == Deed::came || deed.what == Deed::left) {
        in[deed.at_us] = deed.what == Deed::came;
        continue;
      }
      const unsigned kind = deed.what == Deed::unknown ? 1U : deed.what == Deed::miss ? 2U : 4U;
      attempts += (count & kind) != 0 ? 1 : 0;
    }
    return count == 0 ? (!in.empty() && in.rbegin()->second ? 1 : 0) : attempts;
  }
  // What is told of it, or follows from what is told at the same time, and of which week; −1: neither.
  static std::pair<int, std::int64_t> value(const ToldCells& told, unsigned count) {
    const auto& [learners, attempts, with_hit, hits, simulated] = told.cells;
    EXPECT_EQ(simulated, 0) << "of people alone";
    if (count == 0) return {learners, told.learners_us};
    if (count == 7) return {attempts, told.attempts_us};
    const bool both = hits >= 0 && told.hits_us == told.attempts_us;
    if (hits < 0 || ((count & 1U) != 0 && !both)) return {-1, 0};
    const int unknown = attempts - with_hit, missed = with_hit - hits;
    return {((count & 1U) != 0 ? unknown : 0) + ((count & 2U) != 0 ? missed : 0) + ((count & 4U) != 0 ? hits : 0),
            told.hits_us};
  }
  void run() {
    std::set<std::string> people, programmes;
    std::map<std::string, std::set<std::string>> of;
    for (const CohortPast& past : pasts) {
      programmes.insert(past.programme);
      for (const CohortDeed& deed : past.deeds) {
        people.insert(deed.person_id);
        of[deed.person_id].insert(past.programme);
      }
    }
    struct View {
      const CohortPast* past;
      std::int64_t until_us;
    };
    for (unsigned kind = 0; kind < 8; ++kind) {
      std::vector<View> views{{nullptr, 0}};  // nothing, from which everything differs by itself
      std::set<std::pair<const CohortPast*, std::int64_t>> known;
      for (const auto& week : weeks)
        for (const CohortPast& past : pasts) {
          const auto [told, until_us] = value(week.at(past.cohort_id), kind);
          if (told < 0) continue;
          int sum = 0;
          for (const std::string& who : people) sum += share(past, who, kind, until_us);
          wrong += sum != told ? 1 : 0;
          if (known.emplace(&past, until_us).second) views.push_back({&past, until_us});
        }
      for (std::size_t a = 0; a < views.size(); ++a)
        for (std::size_t b = a + 1; b < views.size(); ++b) {
          // Whoever reads a cohort by its counts directs none of its programme.
          std::set<std::string> own;
          for (const View* view : {&views[a], &views[b]})
            if (view->past != nullptr) own.insert(view->past->programme);
          std::set<std::string> differing;
          for (const std::string& who : people) {
            const auto of_view = [&](const View& view) {
              return view.past == nullptr ? 0 : share(*view.past, who, kind, view.until_us);
            };
            if (of_view(views[a]) != of_view(views[b])) differing.insert(who);
          }
          // Every set of such directors.
          std::vector<std::string> others;
          for (const std::string& programme : programmes)
            if (!own.contains(programme)) others.push_back(programme);
          for (unsigned bits = 1; bits < (1U << others.size()); ++bits) {
            std::size_t left = 0;
            for (const std::string& who : differing) {
              bool seen = false;
              for (std::size_t i = 0; i < others.size(); ++i)
                seen = seen || ((bits >> i & 1U) != 0 && of[who].contains(others[i]));
              left += seen ? 0 : 1;
            }
            leaks += left > 0 && left < 5 ? 1 : 0;
            ++looked_at;
          }
        }
    }
  }
};

// Three programmes, two cohorts of each, some people in two of them, and three weeks of few attempts. Who is in two
// is so from the first week on: nothing takes back what was told before somebody else came to see them.
std::vector<CohortPast> random_pasts(unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  std::vector<std::set<int>> people(6);
  std::map<int, int> cohorts_of;
  for (int i = 0; i < 6; ++i) {
    const auto size = static_cast<std::size_t>(3 + below(9));
    // Mostly people of its own, some of the next cohort's.
    while (people[static_cast<std::size_t>(i)].size() < size)
      people[static_cast<std::size_t>(i)].insert((i * 12 + below(below(4) == 0 ? 18 : 12)) % 72);
    for (const int person : people[static_cast<std::size_t>(i)]) ++cohorts_of[person];
  }
  std::vector<CohortPast> pasts;
  for (int i = 0; i < 6; ++i) {
    CohortPast past{"c" + std::to_string(i), "programme " + std::to_string(i / 2), {}};
    const bool eager = below(2) == 0;
    for (const int person : people[static_cast<std::size_t>(i)]) {
      const std::string id = "p" + std::to_string(person);
      const int came = cohorts_of[person] == 1 && below(8) == 0 ? 1 : 0;
      past.deeds.push_back({id, in_week(came, 1), Deed::came});
      for (int week = came; week < 3; ++week)
        for (int n = eager ? below(3) + below(2) : below(5) == 0 ? 1 : 0; n > 0; --n)
          past.deeds.push_back({id, in_week(week, 2 + below(100)),
                                below(10) == 0  ? Deed::unknown
                                : below(2) == 0 ? Deed::hit
                                                : Deed::miss});
      if (below(10) == 0) past.deeds.push_back({id, in_week(2, 160), Deed::left});
    }
    pasts.push_back(std::move(past));
  }
  return pasts;
}

Attack attack(unsigned seed, int smallest) {
  Attack made;
  made.pasts = random_pasts(seed);
  for (int week = 1; week <= 3; ++week) made.weeks.push_back(told_cells(made.pasts, told_at(week), smallest));
  made.run();
  return made;
}

constexpr unsigned kLibraries = 100;

TEST(ToldCells, TheAttackFindsWhatIsNotSuppressed) {
  int leaks = 0;
  for (unsigned seed = 0; seed < kLibraries; ++seed) leaks += attack(seed, 1).leaks;
  EXPECT_GT(leaks, 1000) << "it would not find anything";
}

TEST(ToldCells, NoTwoCountsOfAnyWeeksAndReadersTellOfOneToFourPeople) {
  int leaks = 0, looked_at = 0, wrong = 0, told = 0;
  for (unsigned seed = 0; seed < kLibraries; ++seed) {
    const Attack made = attack(seed, kSmallestCell);
    leaks += made.leaks;
    looked_at += made.looked_at;
    wrong += made.wrong;
    for (const auto& [cohort_id, cells] : made.weeks.back()) told += cells.cells.attempts > 0 ? 1 : 0;
  }
  EXPECT_EQ(leaks, 0);
  EXPECT_EQ(wrong, 0) << "what is told is true of the week of which it tells";
  EXPECT_GT(looked_at, 10'000);
  EXPECT_GT(told, 60) << "who is told nothing learns nothing";
}

TEST(ToldCells, WhatWasToldOfAWeekStays) {
  for (unsigned seed = 0; seed < kLibraries; ++seed) {
    const auto pasts = random_pasts(seed);
    auto fewer = pasts;
    for (CohortPast& past : fewer)
      std::erase_if(past.deeds, [](const CohortDeed& deed) { return deed.at_us >= in_week(1, 0); });
    EXPECT_EQ(told_cells(pasts, told_at(1)), told_cells(fewer, told_at(1)));
  }
}

// As the library holds it.
TEST(ToldCellsOfLibrary, AttemptsWhileInTheCohortCount) {
  Library library = open_library(fresh_folder() / "library");
  const std::string case_id = add_case(library, sample_case());
  const std::string lesion_id = add_lesion(library, case_id, sample_lesion()).value();
  const std::string cohort = add_cohort(library, "Autumn", "Radiology", "").value();
  for (int i = 0; i < 5; ++i) {
    const std::string person =
        add_user(library, "learner " + std::to_string(i), Role::trainee, "a long password").value();
    ASSERT_TRUE(enrol(library, cohort, person, Post::learner).has_value());
    for (const int hour : {-30, 2, 3, 4}) {
      NewAttempt made = sample_attempt(case_id, lesion_id);
      made.recording = sample_recording(20);
      made.picture_png.clear();
      made.person_id = person;
      made.operator_name = kPersonOperator;
      made.started_us = in_week(0, hour);
      const std::optional<double> hit = hour == 4 ? std::nullopt : std::optional(hour == 2 ? 1.0 : 0.0);
      made.metrics = {{"hit", 1, hit, "bool", hit ? "" : "no_endpoint"}};
      ASSERT_TRUE(add_attempt(library, made).has_value());
    }
  }
  library.database().run("UPDATE enrolment SET from_us = " + std::to_string(in_week(0)));
  const auto told = told_cells(list_cohort_pasts(library), told_at(1));
  EXPECT_EQ(told.at(cohort).cells, (CohortCells{5, 15, 10, 5}));
}

}  // namespace
}  // namespace seldinger::casedb
