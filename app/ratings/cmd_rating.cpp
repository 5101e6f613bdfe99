// rating show, export.
#include <cstdio>

#include "app/cli/file.h"
#include "app/questionnaires/acting_in_round.h"
#include "app/ratings/rating_json.h"
#include "reports/questionnaires/ratings_csv.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

namespace rated = assessment::rating;

base::Result<casedb::SentRatings> ratings_to_read(casedb::Library& library, const Arguments& arguments) {
  const auto round = round_to_read(library, arguments);
  if (!round) return round.error();
  return casedb::list_ratings(library, round->code);
}

std::string estimate_text(const std::optional<rated::Estimated>& one) {
  if (!one) return "too few";
  const auto text = [](double value) { return reports::number_text(value, 2); };
  return text(one->value) + " [" + text(one->ci95.low) + " to " + text(one->ci95.high) + "]";
}

std::string answer_text(const assessment::statistics::Answer& answer) {
  if (!answer.estimable()) return "none (" + answer.reason + ")";
  std::string text = reports::number_text(answer.estimate.value_or(0.0), 2);
  if (answer.ci95)
    text += " [" + reports::number_text(answer.ci95->low, 2) + " to " + reports::number_text(answer.ci95->high, 2) +
            "]";
  return text;
}

void print_agreement(const std::string& item_id, const rated::Agreement& agreement) {
  std::printf("\n%s: %zu ratings of %zu replays whose ratings are complete\n",
              item_id.empty() ? "mean" : item_id.c_str(), agreement.ratings, agreement.one.n);
  std::printf("  ICC of one rating %s, of a replay's mean %s\n", answer_text(agreement.one).c_str(),
              answer_text(agreement.mean).c_str());
  if (!item_id.empty()) std::printf("  quadratic kappa %s\n", answer_text(agreement.kappa).c_str());
  for (const rated::RaterResult& one : agreement.raters) {
    std::printf("  %-4s %3zu rated, severity %s, drift in ten ratings %s\n", one.rater.c_str(), one.rated,
                estimate_text(one.severity).c_str(), estimate_text(one.drift).c_str());
    if (one.off_known)
      std::printf("       off known scores by %s in %zu\n", reports::number_text(*one.off_known, 2).c_str(),
                  one.calibrated);
    if (one.off_self)
      std::printf("       one rating is wrong by %s, from %zu rated twice\n",
                  reports::number_text(*one.off_self, 2).c_str(), one.repeated);
  }
}

int run_rating_show(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto ratings = ratings_to_read(*library, arguments);
  if (!ratings) return refuse(ratings.error());
  Agreements agreements{{"", rated::agreement_of(casedb::scores_of(*ratings, ""), ratings->each)}};
  for (const auto& item : ratings->form.form.items)
    if (item.kind == assessment::questionnaire::ItemKind::scale)
      agreements.emplace_back(item.id, rated::agreement_of(casedb::scores_of(*ratings, item.id), ratings->each));
  if (arguments.has("--json")) {
    std::fputs(json_of_agreements(*ratings, agreements).c_str(), stdout);
    return kDone;
  }
  std::printf("%s  %s version %d: %zu of %zu ratings sent\n", ratings->round.code.c_str(),
              ratings->round.form_id.c_str(), ratings->round.version, ratings->ratings.size(), ratings->asked);
  if (ratings->ratings.empty()) return kDone;  // nothing to agree on yet
  if (const std::size_t simulated = casedb::count_simulated(*ratings); simulated > 0)
    std::printf("SIMULATED: %zu of them are by simulated raters; they say nothing about people.\n", simulated);
  for (const auto& [item_id, agreement] : agreements) print_agreement(item_id, agreement);
  return kDone;
}

int run_rating_export(const Arguments& arguments) {
  const auto out = file_of("--out", arguments.required("--out"), {".csv"});
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto ratings = ratings_to_read(*library, arguments);
  if (!ratings) return refuse(ratings.error());
  if (const auto noted = note_export(*library, ratings->round, ratings->ratings.size()); !noted)
    return refuse(noted.error());
  write_file(out, reports::ratings_csv(*ratings, arguments.has("--all")));
  std::printf("%zu of %zu ratings sent\n", ratings->ratings.size(), ratings->asked);
  return kDone;
}

constexpr Option kRatingExportOptions[] = {
    kLibrary,
    {"--out", "FILE.csv", "the file: a line for each rating, as `seldinger stats` takes it"},
    {"--all", nullptr, "also the calibration set and the repeated ratings; the column part tells them apart"}};

}  // namespace

Command rating_show_command() {
  return {.name = "rating show",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary =
              "Shows how far raters agree so far: with each other, with known scores and with themselves; how "
              "severe each is, and whether that drifts.",
          .run = &run_rating_show};
}

Command rating_export_command() {
  return {.name = "rating export",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kRatingExportOptions,
          .acts = true,
          .summary = "Writes how each rater, by pseudonym, rated each attempt.",
          .run = &run_rating_export};
}

}  // namespace seldinger::app
