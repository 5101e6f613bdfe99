#include "casedb/ratings/rating_rounds.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <span>

#include "casedb/database/credentials.h"
#include "casedb/database/new_assets.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/questionnaires/drawn_word.h"
#include "sim/base/ascii.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

namespace questionnaire = assessment::questionnaire;
namespace rating = assessment::rating;

constexpr std::size_t kKeyLength = 12;  // of 31 letters: 59 bits

std::string task_secret(const std::string& secret, std::size_t number) {
  return secret + "/" + std::to_string(number);
}

std::vector<std::byte> bytes_of_text(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

base::Result<void> check_design(const NewRatingRound& made) {
  const bool raters = made.raters >= 1 && made.raters <= rating::kMostRaters && made.each >= 1 &&
                      made.each <= made.raters && made.repeats <= made.replays.size();
  if (made.replays.empty() || made.replays.size() + made.calibration.size() > kMostRatedReplays || !raters)
    return base::Error{"bad_design", "one to " + std::to_string(kMostRatedReplays) +
                                         " replays are rated by one to " + std::to_string(rating::kMostRaters) +
                                         " raters, each by no more than there are"};
  return {};
}

using Known = std::map<std::string, double>;

// The scores of the calibration set, replay by replay.
base::Result<std::vector<Known>> read_known(const questionnaire::Form& form, const NewRatingRound& made) {
  std::vector<Known> all;
  base::Error error{"bad_answers", "known scores do not fit the form"};
  for (std::size_t i = 0; i < made.calibration.size(); ++i) {
    const std::string where = "calibration row " + std::to_string(i + 1) + ": ";
    Known& known = all.emplace_back();
    for (const auto& [item_id, typed] : made.calibration[i].known) {
      const questionnaire::Item* item = form.find_item(item_id);
      if (item == nullptr || item->kind != questionnaire::ItemKind::scale) {
        error.findings.push_back({"bad_answer", where + "there is no item on a scale of that id"});
        continue;
      }
      const auto answer = questionnaire::answer_from_text(form, *item, typed);
      if (!answer) error.findings.push_back({"bad_answer", where + "item " + item_id + " " + answer.error().text});
      if (answer && answer->value) known.emplace(item_id, *answer->value);
    }
    if (known.empty()) error.findings.push_back({"bad_answer", where + "there is no known score"});
  }
  if (!error.findings.empty()) return error;
  return all;
}

std::vector<std::string> add_views(Library& library, const std::string& round_id,
                                   const std::vector<NewRatedReplay>& replays,
                                   const std::vector<std::string>& sheets, bool calibration) {
  std::vector<std::string> ids;
  for (std::size_t i = 0; i < replays.size(); ++i) {
    ids.push_back(new_uuid());
    question(library.database(), "add_rating_view")
        .bind("view_id", ids.back())
        .bind("round_id", round_id)
        .bind("attempt_id", replays[i].attempt_id)
        .bind("calibration", calibration ? 1 : 0)
        .bind("sheet_sha256", sheets[i])
        .run();
  }
  return ids;
}

// A draft for each replay of a rater's.
void add_tasks(Library& library, const Round& round, const StoredForm& form, const std::string& rater,
               const std::string& secret, const std::vector<rating::Assigned>& order,
               const std::vector<std::string>& replays, const std::vector<std::string>& calibration) {
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::string response_id = new_uuid();
    char number[24];
    std::snprintf(number, sizeof number, "-%03zu", i + 1);
    question(library.database(), "add_response_set")
        .bind("response_id", response_id)
        .bind("round_id", round.round_id)
        .bind("questionnaire_id", form.questionnaire_id)
        .bind("respondent", rater + number)
        .bind("group_name", "")
        .bind("source", "page")
        .bind("draft_key", draft_key(task_secret(secret, i + 1)))
        .bind("now_us", now_us())
        .run();
    const bool known = order[i].part == rating::Part::calibration;
    question(library.database(), "add_rating")
        .bind("response_id", response_id)
        .bind("round_id", round.round_id)
        .bind("rater", rater)
        .bind("number", static_cast<std::int64_t>(i + 1))
        .bind("view_id", (known ? calibration : replays).at(order[i].view))
        .bind("part", base::name_of(kRatingPartNames, order[i].part))
        .run();
  }
}

std::vector<std::string> store_sheets(NewAssets& assets, const std::vector<NewRatedReplay>& replays) {
  std::vector<std::string> hashes;
  for (const NewRatedReplay& one : replays) hashes.push_back(assets.add(bytes_of_text(one.sheet)));
  return hashes;
}

struct Rater {
  std::string round_id, rater;
};
base::Result<Rater> find_rater(Library& library, const std::string& secret) {
  Statement row = question(library.database(), "rater_of_key");
  if (!row.bind("key_hash", draft_key(secret)).step()) return base::Error{"no_rater", "nobody rates with that key"};
  return Rater{row.text("round_id"), row.text("rater")};
}

Known known_of(Library& library, const std::string& view_id) {
  Known known;
  Statement rows = question(library.database(), "rating_known_of_view");
  for (rows.bind("view_id", view_id); rows.step();) known.emplace(rows.text("item_id"), rows.real("value"));
  return known;
}

base::Result<AskedRating> find_task(Library& library, const std::string& secret, std::size_t number) {
  const auto rater = find_rater(library, secret);
  if (!rater) return rater.error();
  for (AskedRating& one : list_asked_ratings(library, rater->round_id))
    if (one.rater == rater->rater && one.task.number == number) return std::move(one);
  return base::Error{"no_rating", "there is no replay of that number on this bench"};
}

}  // namespace

base::Result<OpenedRatingRound> open_rating_round(Library& library, const NewRatingRound& made) {
  if (const auto fit = check_design(made); !fit) return fit.error();
  NewAssets assets(library);
  const auto replay_sheets = store_sheets(assets, made.replays);
  const auto calibration_sheets = store_sheets(assets, made.calibration);
  std::array<std::byte, 8> random{};
  fill_random(random);
  std::uint64_t seed = 0;
  std::memcpy(&seed, random.data(), sizeof seed);
  seed = made.seed.value_or(seed);

  Transaction transaction(library.database());
  assets.make_sure();
  const auto forms = find_forms(library, made.round.form_id, made.round.version);
  if (!forms) return forms.error();
  const StoredForm& form = forms->front();
  if (!questionnaire::has_one_measure(form.form))
    return base::Error{"bad_rating_form",
                       "replays are rated on scales that all go from the same to the same value"};
  const auto known = read_known(form.form, made);
  if (!known) return known.error();
  auto round = add_round(library, made.round);
  if (!round) return round.error();
  std::array<std::byte, 8> seed_bytes{};
  std::memcpy(seed_bytes.data(), &seed, sizeof seed);
  question(library.database(), "add_rating_round")
      .bind("round_id", round->round_id)
      .bind("each", static_cast<std::int64_t>(made.each))
      .bind("seed", base::hex_from_bytes(seed_bytes))
      .run();
  const auto replays = add_views(library, round->round_id, made.replays, replay_sheets, false);
  const auto calibration = add_views(library, round->round_id, made.calibration, calibration_sheets, true);
  for (std::size_t i = 0; i < calibration.size(); ++i)
    for (const auto& [item_id, value] : (*known)[i])
      question(library.database(), "add_rating_known")
          .bind("view_id", calibration[i])
          .bind("item_id", item_id)
          .bind("value", value)
          .run();
  const auto orders =
      rating::assigned({made.replays.size(), made.calibration.size(), made.raters, made.each, made.repeats, seed});
  OpenedRatingRound opened;
  for (std::size_t i = 0; i < made.raters; ++i) {
    const std::string rater = "R" + std::to_string(i + 1);
    opened.keys.push_back(drawn_word(kSmallLetters, kKeyLength));
    const std::string secret = rater_secret(opened.keys.back());
    question(library.database(), "add_rating_rater")
        .bind("round_id", round->round_id)
        .bind("rater", rater)
        .bind("key_hash", draft_key(secret))
        .run();
    add_tasks(library, *round, form, rater, secret, orders[i], replays, calibration);
    opened.keys.back().insert(8, "-").insert(4, "-");
  }
  opened.round = *find_round(library, round->code);
  transaction.commit();
  assets.keep();
  return opened;
}

std::vector<AskedRating> list_asked_ratings(Library& library, const std::string& round_id) {
  std::vector<AskedRating> asked;
  Statement rows = question(library.database(), "ratings_of_round");
  for (rows.bind("round_id", round_id); rows.step();) {
    AskedRating& one = asked.emplace_back();
    one.response_id = rows.text("response_id");
    one.rater = rows.text("rater");
    one.view_id = rows.text("view_id");
    one.attempt_id = rows.text("attempt_id");
    one.sheet_sha256 = rows.text("sheet_sha256");
    one.simulated = rows.integer("simulated") != 0;
    one.task.number = static_cast<std::size_t>(rows.integer("number"));
    one.task.part = base::from_name(kRatingPartNames, rows.view("part")).value_or(assessment::rating::Part::rated);
    one.task.sent = !rows.is_null("submitted_us");
  }
  return asked;
}

std::string rater_secret(const std::string& typed_key) {
  std::string key;
  for (const char c : typed_key)
    if (c != ' ' && c != '-') key += base::lower(c);
  return sha256_hex(std::as_bytes(std::span(key)));
}

base::Result<RatingBench> find_rating_bench(Library& library, const std::string& secret) {
  const Snapshot snapshot(library.database());
  const auto rater = find_rater(library, secret);
  if (!rater) return rater.error();
  const auto round = find_round(library, rater->round_id);
  if (!round) return round.error();
  const auto forms = find_forms(library, round->form_id, round->version);
  if (!forms) return forms.error();
  RatingBench bench{*round, forms->front().form.title, forms->front().form.introduction, rater->rater, {}};
  for (const AskedRating& one : list_asked_ratings(library, rater->round_id))
    if (one.rater == rater->rater) bench.tasks.push_back(one.task);
  return bench;
}

base::Result<RatingPage> find_rating(Library& library, const std::string& secret, std::size_t number) {
  const Snapshot snapshot(library.database());
  const auto task = find_task(library, secret, number);
  if (!task) return task.error();
  const auto rater = find_rater(library, secret);
  if (!rater) return rater.error();
  const auto round = find_round(library, rater->round_id);
  if (!round) return round.error();
  auto forms = find_forms(library, round->form_id, round->version);
  if (!forms) return forms.error();
  const auto sheet = library.load_asset(task->sheet_sha256);
  if (!sheet) return sheet.error();
  RatingPage page{task->task, *round, std::move(forms->front()), answers_of(library, task->response_id), {}, {}};
  page.sheet.resize(sheet->size());
  std::memcpy(page.sheet.data(), sheet->data(), sheet->size());
  if (task->task.sent) page.known = known_of(library, task->view_id);
  return page;
}

base::Result<void> keep_rating(Library& library, const std::string& secret, std::size_t number,
                               const std::map<std::string, std::string>& typed, bool send) {
  const auto task = find_task(library, secret, number);
  if (!task) return task.error();
  if (task->task.sent) return base::Error{"rating_sent", "this rating was sent, and stays as it is"};
  const std::string draft = task_secret(secret, number);
  if (const auto kept = save_draft(library, draft, typed); !kept) return kept.error();
  return send ? submit_draft(library, draft) : base::Result<void>();
}

base::Result<SentRatings> list_ratings(Library& library, const std::string& code) {
  const Snapshot snapshot(library.database());
  const auto round = find_round(library, code);
  if (!round) return round.error();
  if (!round->rated) return base::Error{"not_rated", "that code is for a questionnaire, not for rating replays"};
  auto forms = find_forms(library, round->form_id, round->version);
  if (!forms) return forms.error();
  SentRatings all{*round, std::move(forms->front()), 0, 0, {}};
  Statement row = question(library.database(), "rating_round");
  if (row.bind("round_id", round->round_id).step()) all.each = static_cast<std::size_t>(row.integer("each"));
  for (const AskedRating& one : list_asked_ratings(library, round->round_id)) {
    ++all.asked;
    if (!one.task.sent) continue;
    all.ratings.push_back({one.rater, one.view_id, one.attempt_id, one.task.part, one.task.number,
                           answers_of(library, one.response_id), known_of(library, one.view_id), one.simulated});
  }
  return all;
}

std::size_t count_simulated(const SentRatings& ratings) {
  return static_cast<std::size_t>(std::count_if(ratings.ratings.begin(), ratings.ratings.end(),
                                                [](const SentRating& one) { return one.simulated; }));
}

std::vector<rating::Rating> scores_of(const SentRatings& ratings, const std::string& item_id) {
  const questionnaire::Form& form = ratings.form.form;
  const questionnaire::Item* item = form.find_item(item_id);
  std::vector<rating::Rating> scores;
  const auto score_of = [&](const ItemAnswers& answers) -> std::optional<double> {
    if (item_id.empty()) return questionnaire::mean_score(form, answers);
    const auto found = answers.find(item_id);
    return item == nullptr || found == answers.end() ? std::nullopt
                                                     : questionnaire::scored(form, *item, found->second);
  };
  for (const SentRating& one : ratings.ratings) {
    const auto score = score_of(one.answers);
    if (!score) continue;
    rating::Rating row{one.rater, one.view_id, one.part, one.number, *score, {}};
    ItemAnswers known;
    for (const auto& [id, value] : one.known)
      known.emplace(id, questionnaire::ItemAnswer{questionnaire::AnswerState::answered, value, {}});
    row.known = score_of(known);
    scores.push_back(std::move(row));
  }
  return scores;
}

}  // namespace seldinger::casedb
