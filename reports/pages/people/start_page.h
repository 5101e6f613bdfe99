// Where somebody lands: what there is for them to do now, by role.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/keeping/health.h"
#include "reports/pages/page.h"
#include "reports/pages/people/learner_view.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {

// What a mentor said of an attempt.
struct SaidOfAttempt {
  std::string attempt_id, case_title;
  CommentView comment;
};
struct TraineeStart {
  Records records;
  std::optional<AttemptView> last;  // their newest attempt, graded
  std::vector<SaidOfAttempt> said;  // of their newest attempts, newest first
};
std::string trainee_start_page(const Visitor& visitor, const TraineeStart& start);

// A case in review, and what it waits for.
struct CaseInReview {
  std::string case_id, title;
  bool approved = false;    // it waits to be published, else to be approved
  bool for_reader = false;  // who may do that
};
// Of who answers for others: a mentor, a director.
struct LeaderStart {
  std::vector<LearnerView> learners;
  std::vector<CaseInReview> reviews;
  std::vector<AttemptView> uncommented;  // that did not pass, and nobody has said anything of
  std::vector<std::string> drafts;       // titles of curricula that the reader may publish
  std::int64_t now_us = 0;
};
std::string leader_start_page(const Visitor& visitor, const LeaderStart& start);

// Of who runs the server.
struct AdminStart {
  casedb::Health health = casedb::Health::ok;
  std::string program_version;
  std::size_t open_accounts = 0, closed_accounts = 0, delayed = 0;
};
std::string admin_start_page(const Visitor& visitor, const AdminStart& start);

}  // namespace seldinger::reports
