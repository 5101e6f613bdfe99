// Who may do what: one table, which commands, the workstation's window and the dashboard ask. Deny by default.
// Whose something is (one's own, one's cohort's, …) is asked of casedb/people/relations.h.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

#include "casedb/cases/case_state.h"
#include "casedb/cases/cases.h"
#include "casedb/people/people.h"
#include "casedb/people/relations.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

enum class Action {
  // Attempts.
  see_attempt,
  see_recording,      // its course pose by pose: more than to see it, since a hand's movements are its own
  see_operator_name,  // the log-in name of the person who made it; without it, a pseudonym
  see_free_text,      // what somebody typed, and the time of day of what was done
  see_expert_replay,  // an expert's recording, shown before one's own attempt
  practise_case,      // a draft only once attempts have frozen it (casedb/grading/choices.h)
  skip_gates,         // practise a curriculum's case before what it is gated by is passed
  look_inside,        // into the patient, while an attempt is watched
  cause_event,        // let something happen to the patient during an attempt
  simulate_attempts,
  comment_attempt,  // at a moment of it, for its trainee to read
  // Cases.
  see_case,         // what it holds, also what is right: more than to practise it
  see_case_notes,   // what people wrote beside their decisions
  see_who_decided,  // by the log-in name; without it, a pseudonym
  work_on_case,     // in the case editor
  confirm_no_burned_in_text,
  overrule_face,  // says that what the detector of faces found is none
  submit_case,
  approve_case,  // "own": one's own submission
  return_case,
  publish_reviewed_case,  // "own": made or submitted by oneself
  publish_unreviewed_case,
  retire_case,  // "own": published by oneself
  make_case_version,
  add_case,
  hand_out_case,  // as a bundle
  // Curricula.
  see_curriculum,
  see_progress,  // how far somebody is in a curriculum
  make_curriculum,
  release_curriculum,  // publishes it
  remove_draft_curriculum,
  retire_curriculum,
  // Standards. "own": one that grades oneself.
  see_standard_attempts,  // which attempts made it
  set_standard,
  propose_cut,  // by a method of standard setting
  freeze_cut,   // "own": proposed by oneself
  // People.
  see_cohort,             // who is in it, by name
  see_cohort_cells,       // how many are in it and what they did together, from kSmallestCell people upwards
  see_station_use,        // what was done at which workstation
  manage_cohorts,         // makes them, says who belongs to them
  appoint_director,       // of a programme
  manage_studies,         // what they ask, who works on them
  export_study,           // attempts of those who consent, without names
  plan_study,             // its plan, the freeze, deviations, looks and reports
  enrol_in_study,         // people who consent to it
  manage_questionnaires,  // stores them, opens rounds in which they are answered
  see_responses,   // of a round: by respondent and group. "own": opened by oneself; of a study: its researchers'
  run_job,         // long work that a page asks for: only one's own is seen
  answer_consent,  // give and withdraw, and state facts of oneself
  let_in_again,    // somebody whose log-in is delayed
  erase_attempts,
  erase_person,
  erase_case,
  manage_accounts,  // add, close, open; role, level
  set_password,
  // The library.
  keep_library,        // back up, repair, score again
  see_station_timing,  // how well each workstation keeps time
  read_audit,
};

// A set of roles.
class Roles {
 public:
  constexpr Roles(std::initializer_list<Role> roles) {
    for (const Role role : roles) bits_ |= bit_of(role);
  }
  constexpr bool has(Role role) const noexcept { return (bits_ & bit_of(role)) != 0; }
  constexpr Roles operator|(Roles other) const noexcept {
    other.bits_ |= bits_;
    return other;
  }
  constexpr bool operator==(const Roles&) const noexcept = default;

 private:
  static constexpr unsigned bit_of(Role role) noexcept { return 1U << static_cast<unsigned>(role); }
  unsigned bits_ = 0;
};
inline constexpr Role kAllRoles[] = {Role::trainee, Role::mentor, Role::researcher, Role::director, Role::admin};
inline constexpr Roles kEveryRole = {Role::trainee, Role::mentor, Role::researcher, Role::director, Role::admin};

// What something is done to: the state it is in, where the action depends on it, and whose it is. A case's state
// never stands for a curriculum's.
struct Subject : Relation {
  constexpr Subject() = default;
  constexpr Subject(CaseState its) : state_bit(1U << static_cast<unsigned>(its)) {}           // NOLINT
  constexpr Subject(CurriculumState its) : state_bit(0x10U << static_cast<unsigned>(its)) {}  // NOLINT
  constexpr Subject(const Relation& whose) : Relation(whose) {}                               // NOLINT
  static constexpr Subject whose(bool own) {
    Subject subject;
    subject.own = own;
    return subject;
  }
  unsigned state_bit = 0x100;  // of no state
};

// A set of states.
class States {
 public:
  constexpr States() : bits_(Subject().state_bit) {}  // the action does not depend on one
  constexpr States(std::initializer_list<Subject> states) {
    for (const Subject& one : states) bits_ |= one.state_bit;
  }
  constexpr bool has(const Subject& subject) const noexcept { return (bits_ & subject.state_bit) != 0; }

 private:
  unsigned bits_ = 0;
};

enum class Whose { anybodys, own, anothers, own_cohorts, own_programmes, own_studies, nobodys, reaching, agreed };
constexpr bool is(Whose whose, const Relation& relation) noexcept {
  switch (whose) {
    case Whose::anybodys:
      return true;
    case Whose::own:
      return relation.own;
    case Whose::anothers:
      return !relation.own;
    case Whose::own_cohorts:
      return relation.own_cohort;
    case Whose::own_programmes:
      return relation.own_programme;
    case Whose::own_studies:
      return relation.own_study;
    case Whose::nobodys:
      return relation.nobodys;
    case Whose::reaching:
      return relation.reached;
    case Whose::agreed:
      return relation.agreed;
  }
  return false;
}

// Roles that may do something to what is in one of the states, and whose it must be.
struct Grant {
  Roles who{};
  States states{};
  Whose whose = Whose::anybodys;
  constexpr bool covers(Role role, const Subject& subject) const noexcept {
    return who.has(role) && states.has(subject) && is(whose, subject);
  }
};

struct Permission {
  Action action;
  std::string_view name;
  std::string_view rule;  // in words, as a refusal gives them
  Grant grants[5] = {};   // any of them is enough
};

// One row for each action, in their order.
inline constexpr Permission kPermissions[] = {
    {Action::see_attempt,
     "see_attempt",
     "a trainee sees their own attempts, a mentor also those of the own cohort, a director those of the own "
     "programmes, a researcher those of consenting people in own studies; simulated ones a mentor or a researcher",
     {{{Role::trainee, Role::mentor}, {}, Whose::own},
      {{Role::mentor}, {}, Whose::own_cohorts},
      {{Role::director}, {}, Whose::own_programmes},
      {{Role::researcher}, {}, Whose::own_studies},
      {{Role::mentor, Role::researcher}, {}, Whose::nobodys}}},
    {Action::see_recording,
     "see_recording",
     "whoever sees an attempt by name sees its recording; a researcher those of simulated operators, and people's "
     "by an "
     "export with a key",
     {{{Role::trainee, Role::mentor}, {}, Whose::own},
      {{Role::mentor}, {}, Whose::own_cohorts},
      {{Role::director}, {}, Whose::own_programmes},
      {{Role::mentor, Role::researcher}, {}, Whose::nobodys}}},
    {Action::see_operator_name,
     "see_operator_name",
     "names are read in the own cohort and the own programmes; a researcher reads pseudonyms",
     {{{Role::trainee, Role::mentor}, {}, Whose::own},
      {{Role::mentor}, {}, Whose::own_cohorts},
      {{Role::director}, {}, Whose::own_programmes}}},
    {Action::see_free_text,
     "see_free_text",
     "a researcher reads days, and nothing that somebody typed",
     {{{Role::trainee, Role::mentor, Role::director, Role::admin}}}},
    {Action::see_expert_replay,
     "see_expert_replay",
     "everybody is shown simulated experts, and consultants who consent to research with this library",
     {{kEveryRole, {}, Whose::own}, {kEveryRole, {}, Whose::nobodys}, {kEveryRole, {}, Whose::agreed}}},
    {Action::practise_case,
     "practise_case",
     "everybody practises what is published for them, a mentor also a frozen draft",
     {{kEveryRole, {CaseState::published}, Whose::reaching}, {{Role::mentor}, {CaseState::draft}}}},
    {Action::skip_gates,
     "skip_gates",
     "a mentor opens every case of a curriculum, whatever is passed before",
     {{{Role::mentor}}}},
    {Action::look_inside, "look_inside", "the others have to find the way by the pictures", {{{Role::mentor}}}},
    {Action::cause_event, "cause_event", "a mentor lets things happen to the patient", {{{Role::mentor}}}},
    {Action::simulate_attempts,
     "simulate_attempts",
     "a mentor or a researcher has attempts simulated",
     {{{Role::mentor, Role::researcher}}}},
    {Action::comment_attempt,
     "comment_attempt",
     "a mentor comments on attempts of the own cohort",
     {{{Role::mentor}, {}, Whose::own_cohorts}}},

    {Action::see_case,
     "see_case",
     "a mentor sees every case, a director no draft, a researcher or an admin what is or was published",
     {{{Role::mentor}, {CaseState::draft, CaseState::review, CaseState::published, CaseState::retired}},
      {{Role::director}, {CaseState::review, CaseState::published, CaseState::retired}},
      {{Role::researcher, Role::admin}, {CaseState::published, CaseState::retired}}}},
    {Action::see_case_notes,
     "see_case_notes",
     "a mentor or a director reads what reviewers wrote",
     {{{Role::mentor, Role::director}}}},
    {Action::see_who_decided,
     "see_who_decided",
     "who decided about a case signs for it: mentors and directors read the name",
     {{{Role::mentor, Role::director}}}},
    {Action::work_on_case,
     "work_on_case",
     "a mentor works on a case until it is published",
     {{{Role::mentor}, {CaseState::draft, CaseState::review}}}},
    {Action::confirm_no_burned_in_text,
     "confirm_no_burned_in_text",
     "a mentor, director or admin confirms that no text is burned in",
     {{{Role::mentor, Role::director, Role::admin}}}},
    {Action::overrule_face,
     "overrule_face",
     "an admin says that what looks like a face is none",
     {{{Role::admin}}}},
    {Action::submit_case, "submit_case", "a mentor submits a case to review", {{{Role::mentor}}}},
    {Action::approve_case,
     "approve_case",
     "a mentor or a director approves a case, as a second person: not the one who submitted it",
     {{{Role::mentor, Role::director}, {}, Whose::anothers}}},
    {Action::return_case,
     "return_case",
     "a mentor or a director returns a case to draft",
     {{{Role::mentor, Role::director}}}},
    {Action::publish_reviewed_case,
     "publish_reviewed_case",
     "a mentor or a director publishes what was reviewed, as a second person: not the one who made or submitted it",
     {{{Role::mentor, Role::director}, {}, Whose::anothers}}},
    {Action::publish_unreviewed_case,
     "publish_unreviewed_case",
     "only a mentor publishes what no second person has approved, to their own cohort",
     {{{Role::mentor}}}},
    {Action::retire_case,
     "retire_case",
     "an admin, or who published it, retires a case",
     {{{Role::admin}}, {kEveryRole, {}, Whose::own}}},
    {Action::make_case_version, "make_case_version", "a mentor makes a new version", {{{Role::mentor}}}},
    {Action::add_case, "add_case", "a mentor or an admin brings cases in", {{{Role::mentor, Role::admin}}}},
    {Action::hand_out_case,
     "hand_out_case",
     "a mentor, director or admin hands cases out",
     {{{Role::mentor, Role::director, Role::admin}}}},

    {Action::see_curriculum,
     "see_curriculum",
     "a mentor or a director sees every curriculum, a researcher no draft, a trainee what is published",
     {{{Role::mentor, Role::director},
       {CurriculumState::draft, CurriculumState::published, CurriculumState::retired}},
      {{Role::researcher}, {CurriculumState::published, CurriculumState::retired}},
      {{Role::trainee}, {CurriculumState::published}}}},
    {Action::see_progress,
     "see_progress",
     "a trainee sees how far they are, a mentor how far the own cohort is, a director the own programmes",
     {{{Role::trainee}, {}, Whose::own},
      {{Role::mentor}, {}, Whose::own_cohorts},
      {{Role::director}, {}, Whose::own_programmes}}},
    {Action::make_curriculum, "make_curriculum", "a mentor makes a curriculum", {{{Role::mentor}}}},
    {Action::release_curriculum, "publish_curriculum", "a director publishes a curriculum", {{{Role::director}}}},
    {Action::remove_draft_curriculum, "remove_draft_curriculum", "a mentor takes a draft away", {{{Role::mentor}}}},
    {Action::retire_curriculum, "retire_curriculum", "a director retires a curriculum", {{{Role::director}}}},

    {Action::see_standard_attempts,
     "see_standard_attempts",
     "a mentor sees which attempts made a standard",
     {{{Role::mentor}}}},
    {Action::set_standard,
     "set_standard",
     "a director sets a standard that none of their own attempts is part of",
     {{{Role::director}, {}, Whose::anothers}}},
    {Action::propose_cut,
     "propose_cut",
     "a mentor or a director proposes a cut",
     {{{Role::mentor, Role::director}}}},
    {Action::freeze_cut,
     "freeze_cut",
     "a director freezes a cut, as a second person: not the one who proposed it",
     {{{Role::director}, {}, Whose::anothers}}},

    {Action::see_cohort,
     "see_cohort",
     "a mentor sees who is in the own cohort, a director who is in the own programmes",
     {{{Role::mentor}, {}, Whose::own_cohorts}, {{Role::director}, {}, Whose::own_programmes}}},
    {Action::see_cohort_cells,
     "see_cohort_cells",
     "a director sees counts of other programmes, of at least five people",
     {{{Role::director}}}},
    {Action::see_station_use,
     "see_station_use",
     "a director sees what the own programmes did at which station",
     {{{Role::director}, {}, Whose::own_programmes}}},
    {Action::manage_cohorts,
     "manage_cohorts",
     "an admin says who belongs to a cohort, a director within the own programmes",
     {{{Role::admin}}, {{Role::director}, {}, Whose::own_programmes}}},
    {Action::appoint_director, "appoint_director", "an admin says who directs a programme", {{{Role::admin}}}},
    {Action::manage_studies,
     "manage_studies",
     "an admin or a director makes a study, its text, and says who works on it",
     {{{Role::admin, Role::director}}}},
    {Action::export_study,
     "export_study",
     "a researcher exports the attempts of those who consent to an own study",
     {{{Role::researcher}, {}, Whose::own_studies}}},
    {Action::plan_study,
     "plan_study",
     "a researcher plans an own study, freezes the plan, notes deviations and looks at the outcomes",
     {{{Role::researcher}, {}, Whose::own_studies}}},
    {Action::enrol_in_study,
     "enrol_in_study",
     "a researcher enrols those who consent in an own study, an admin or a director in any",
     {{{Role::researcher}, {}, Whose::own_studies}, {{Role::admin, Role::director}}}},
    {Action::manage_questionnaires,
     "manage_questionnaires",
     "a mentor, researcher, director or admin stores questionnaires and opens rounds of them",
     {{{Role::mentor, Role::researcher, Role::director, Role::admin}}}},
    {Action::see_responses,
     "see_responses",
     "a mentor, researcher or director reads the answers of a round that they opened, a researcher those of an own "
     "study",
     {{{Role::mentor, Role::researcher, Role::director}, {}, Whose::own},
      {{Role::researcher}, {}, Whose::own_studies}}},
    {Action::run_job,
     "run_job",
     "a mentor, researcher or admin sees their own jobs",
     {{{Role::mentor, Role::researcher, Role::admin}, {}, Whose::own}}},
    {Action::answer_consent, "answer_consent", "everybody answers for themselves", {{kEveryRole, {}, Whose::own}}},
    {Action::let_in_again,
     "let_in_again",
     "an admin lets somebody try again at once whose log-in is delayed",
     {{{Role::admin}}}},
    {Action::erase_attempts,
     "erase_attempts",
     "an admin erases attempts, or whose they are",
     {{{Role::admin}}, {kEveryRole, {}, Whose::own}}},
    {Action::erase_person, "erase_person", "an admin erases a person", {{{Role::admin}}}},
    {Action::erase_case,
     "erase_case",
     "a mentor deletes a draft, an admin a draft or what is retired",
     {{{Role::mentor, Role::admin}, {CaseState::draft}}, {{Role::admin}, {CaseState::retired}}}},
    {Action::manage_accounts, "manage_accounts", "an admin keeps the accounts", {{{Role::admin}}}},
    {Action::set_password,
     "set_password",
     "an admin sets a password, or whose it is",
     {{{Role::admin}}, {kEveryRole, {}, Whose::own}}},

    {Action::keep_library, "keep_library", "an admin backs the library up and repairs it", {{{Role::admin}}}},
    {Action::see_station_timing,
     "see_station_timing",
     "an admin sees how well each station keeps time",
     {{{Role::admin}}}},
    {Action::read_audit, "read_audit", "an admin reads the audit log", {{{Role::admin}}}},
};

constexpr bool may(Role role, Action action, const Subject& subject = {}) noexcept {
  for (const Grant& grant : kPermissions[static_cast<std::size_t>(action)].grants)
    if (grant.covers(role, subject)) return true;
  return false;
}

// Who may do it to something, whatever its state and whosever it is.
constexpr Roles roles_that_may(Action action) noexcept {
  Roles roles{};
  for (const Grant& grant : kPermissions[static_cast<std::size_t>(action)].grants) roles = roles | grant.who;
  return roles;
}

// `not_allowed`, with the rule in words.
base::Result<void> allow(Role role, Action action, const Subject& subject = {});

// The account of that log-in name: `no_user`, also of one that is closed.
base::Result<Account> open_account(Library& library, const std::string& login_name);
// The same, of somebody in whose name something is done: `not_allowed` when the library acts for somebody else, or
// for nobody (casedb/database/actor.h).
base::Result<Account> acting_account(Library& library, const std::string& login_name);
// The same, if it may.
base::Result<Account> account_that_may(Library& library, const std::string& login_name, Action action,
                                       const Subject& subject = {});

}  // namespace seldinger::casedb
