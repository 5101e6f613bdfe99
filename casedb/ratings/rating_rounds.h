// Replays rated by raters who are not told whose they are. A round is opened with everything that raters will see;
// each has a key of their own and rates under numbers of an order of their own (assessment/rating/assignment.h).
// What they answer is a set of answers to the round's form, kept and sent as every other (casedb/questionnaires).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "assessment/rating/agreement.h"
#include "assessment/rating/assignment.h"
#include "casedb/questionnaires/responses.h"
#include "sim/base/names.h"

namespace seldinger::casedb {

inline constexpr auto kRatingPartNames =
    base::names<assessment::rating::Part>({{assessment::rating::Part::calibration, "calibration"},
                                           {assessment::rating::Part::rated, "rated"},
                                           {assessment::rating::Part::repeated, "repeated"}});

// A replay as it is to be rated.
struct NewRatedReplay {
  std::string attempt_id;
  std::string sheet;                           // what raters see: part of a page, without a word of whose it is
  std::map<std::string, std::string> known{};  // of the calibration set: by item, as typed
};
struct NewRatingRound {
  NewRound round;  // without groups
  std::vector<NewRatedReplay> replays, calibration;
  std::size_t raters = 2, each = 2, repeats = 0;
  std::optional<std::uint64_t> seed{};  // none: drawn
};
struct OpenedRatingRound {
  Round round;
  std::vector<std::string> keys;  // of R1, R2 …: told now and never again
};
inline constexpr std::size_t kMostRatedReplays = 500;
// As add_round, and `bad_design` (no replay, more than kMostRatedReplays, numbers of raters that cannot be),
// `bad_rating_form` (its items have not one scale's ends), `bad_answers` (a known score that is none, or a replay
// of the calibration set without one).
base::Result<OpenedRatingRound> open_rating_round(Library& library, const NewRatingRound& made);

struct RatingTask {
  std::size_t number = 0;
  assessment::rating::Part part = assessment::rating::Part::rated;
  bool sent = false;
};
// What a rater has before them.
struct RatingBench {
  Round round;
  std::string form_title, introduction, rater;
  std::vector<RatingTask> tasks;  // in their order; of people who withdrew from the study there are none any more
};
// What a browser keeps of a key that was typed, blanks, dashes and capitals or not: 64 digits.
std::string rater_secret(const std::string& typed_key);
base::Result<RatingBench> find_rating_bench(Library& library, const std::string& secret);  // `no_rater`

struct RatingPage {
  RatingTask task;
  Round round;
  StoredForm form;
  ItemAnswers answers;
  std::string sheet;
  std::map<std::string, double> known;  // once sent, of the calibration set
};
base::Result<RatingPage> find_rating(Library& library, const std::string& secret,
                                     std::size_t number);  // `no_rater`, `no_rating`, as load_asset
// As save_draft and, where it is sent, submit_draft; `no_rater`, `no_rating`, `rating_sent`.
base::Result<void> keep_rating(Library& library, const std::string& secret, std::size_t number,
                               const std::map<std::string, std::string>& typed, bool send);

// A rating of a round, made or still to be made.
struct AskedRating {
  RatingTask task;
  std::string response_id, rater, view_id, attempt_id, sheet_sha256;
  bool simulated = false;  // by a simulated rater
};
// By rater, in their order; of a study's round only of what people consent to, or nobody made.
std::vector<AskedRating> list_asked_ratings(Library& library, const std::string& round_id);

// What was sent.
struct SentRating {
  std::string rater, view_id, attempt_id;
  assessment::rating::Part part = assessment::rating::Part::rated;
  std::size_t number = 0;
  ItemAnswers answers;
  std::map<std::string, double> known;
  bool simulated = false;  // by a simulated rater
};
struct SentRatings {
  Round round;
  StoredForm form;
  std::size_t each = 0, asked = 0;  // ratings that there are, sent or not
  std::vector<SentRating> ratings;  // by rater, in their order
};
base::Result<SentRatings> list_ratings(Library& library, const std::string& code);  // `no_round`, `not_rated`
std::size_t count_simulated(const SentRatings& ratings);                            // of those sent

// Of an item, or of the mean of all (empty); those without a score are left out.
std::vector<assessment::rating::Rating> scores_of(const SentRatings& ratings, const std::string& item_id);

}  // namespace seldinger::casedb
