// A questionnaire that is answered at the workstation: section after section, as on the page, and a last look
// before it is sent. What is typed is kept as a draft half a second later, as far as it fits its item.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "casedb/questionnaires/responses.h"

namespace seldinger::app {

class Answering {
 public:
  // Goes on with what the draft holds. `no_draft`.
  static base::Result<Answering> open(casedb::Library& library, const std::string& secret);

  const assessment::questionnaire::Form& form() const noexcept { return draft_.form.form; }
  const std::string& respondent() const noexcept { return draft_.set.respondent; }
  // The sections' items; `section()` is one of them, from 0, or as many as there are: the last look.
  const std::vector<std::vector<const assessment::questionnaire::Item*>>& sections() const noexcept {
    return sections_;
  }
  std::size_t section() const noexcept { return section_; }
  bool last_look() const noexcept { return section_ >= sections_.size(); }

  // As answer_from_text reads it; empty: no answer.
  const std::string& typed(const std::string& item_id) const noexcept;
  void type(const std::string& item_id, const std::string& text, double now_s);
  // What is wrong with an item of this section, once one wanted to go on; empty: nothing.
  std::string problem(const std::string& item_id) const;
  // The items but comments that have no answer, each with its section.
  std::vector<std::pair<std::size_t, const assessment::questionnaire::Item*>> open_items() const;

  // Forth: nothing happens while something in this section does not fit its item.
  void next();
  void back();
  void go_to(std::size_t section);  // as back: what does not fit stays typed
  // Keeps what was typed half a second ago and is not kept yet; once a frame.
  void look(double now_s);
  // Keeps all of it now; the error of the library, and what was typed waits.
  base::Result<void> keep();
  bool lost() const noexcept { return lost_; }  // whether the library refused what was to be kept last
  // From the last look alone; the draft is gone. `round_closed`.
  base::Result<void> send();

 private:
  Answering(casedb::Library& library, std::string secret, casedb::Draft draft);
  bool is_missing(const assessment::questionnaire::Item& item) const;

  casedb::Library* library_;
  std::string secret_;
  casedb::Draft draft_;
  std::vector<std::vector<const assessment::questionnaire::Item*>> sections_;
  std::size_t section_ = 0;
  std::map<std::string, std::string> typed_, waiting_;  // waiting: not kept yet
  std::optional<double> typed_at_s_;                    // since then something waits
  bool told_ = false, lost_ = false;                    // told: what does not fit
};

}  // namespace seldinger::app
