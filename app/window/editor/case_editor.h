// The case editor without its window: a stored case, what is chosen and dragged of it, and each change, stored
// at once by the calls that the command line makes. What is refused says why and changes nothing.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/editor/draft_case.h"
#include "app/window/editor/draft_preparation.h"
#include "app/window/editor/draft_rehearsal.h"
#include "app/window/editor/editor_grip.h"
#include "app/window/editor/editor_view.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/versions.h"
#include "sim/imaging/room/draw_list.h"

namespace seldinger::app {

enum class EditorTool { look, lesion, structure, entry, rule, prepare };

// What is at a place.
struct EditorSpot {
  std::optional<double> hu;  // nothing: outside the CT
  volume::TissueClass tissue{};
  std::vector<std::string> in;  // "lesion 1", structures by name
  double depth_mm = 0.0;        // below the skin; < 0: outside the body
};

// Where a ray from outside first meets skin that can be seen: not what is cut away, nor where the CT ends.
std::optional<glm::dvec3> skin_under(const cases::Case& scene, const glm::dvec3& eye_lps_mm, const glm::dvec3& ray,
                                     const std::optional<imaging::CutPlane>& cut);

// A place on the skin that a room looks at before anybody has turned it: the planned entry, else nearest to the
// first lesion, else the patient's middle seen from above.
glm::dvec3 first_look(const cases::Case& scene, const std::vector<casedb::LesionRow>& lesions,
                      const glm::dvec3& up);

class CaseEditor {
 public:
  // `library` must outlive it. `mentor`: the account's name.
  CaseEditor(casedb::Library& library, const std::string& case_id, std::string mentor);

  const casedb::CaseRow& row() const noexcept { return row_; }
  const std::vector<casedb::LesionRow>& lesions() const noexcept { return lesions_; }
  const std::vector<casedb::StructureRow>& structures() const noexcept { return structures_; }
  const std::vector<casedb::Decision>& decisions() const noexcept { return decisions_; }
  // "you", or the log-in name (casedb/cases/permissions.h); of who is erased the pseudonym.
  std::string who(const casedb::Decision& decision) const;
  // Why nothing can be changed; empty: it can.
  const std::string& locked() const noexcept { return locked_; }
  // The last thing that was refused, in words for the screen; empty: the last was not.
  const std::string& refusal() const noexcept { return refusal_; }
  const std::string& said() const noexcept { return said_; }  // what was done last, for the screen

  // Made of what is stored; nothing before the first.
  std::shared_ptr<const CheckedCase> scene() const { return scene_; }
  bool checking() const { return draft_case_.busy() || publish_.has_value(); }
  EditorView view;
  std::optional<EditorSpot> spot(const glm::dvec3& place_lps_mm) const;

  EditorTool tool = EditorTool::look;
  // Chosen of lesions and structures, for tools and fields; past the last: a new one.
  std::size_t lesion = 0, structure = 0;
  // What a click makes where nothing is chosen.
  cases::LesionForm new_lesion;
  casedb::StructureRow new_structure;

  // --- with the mouse on a plane ---
  // Takes hold of what the tool can move there. False: there is nothing.
  bool grab(std::size_t plane, const glm::dvec3& place_lps_mm, double reach_mm);
  bool grabbed() const noexcept { return grip_.has_value(); }
  void drag(std::size_t plane, const glm::dvec3& place_lps_mm);  // shown, not stored
  void let_go();                                                 // stored
  void drop_grip() noexcept;                                     // as it was
  // By the tool: the cursor, the middle of a lesion or structure, the next point of a tube, the entry.
  void click(const glm::dvec3& place_lps_mm);
  // As they are held now, for the picture.
  std::vector<cases::LesionForm> shown_lesions() const;
  std::vector<casedb::StructureRow> shown_structures() const;  // with the new one, once it has a place
  // A tube whose points are being set; stored once it is finished.
  bool drawing() const noexcept { return drawing_; }
  void finish_drawing();
  void drop_drawing();

  // --- changes; each is stored when it returns, or refused ---
  bool put_lesion(std::size_t index, const cases::LesionForm& form);
  bool remove_lesion(std::size_t index);
  bool add_structure(const casedb::StructureRow& structure);
  bool put_structure(std::size_t index, const casedb::StructureRow& structure);
  bool remove_structure(std::size_t index);
  // Onto the nearest skin; nothing: without.
  bool set_entry(const std::optional<glm::dvec3>& place_lps_mm);
  bool set_setting(const casedb::CaseSetting& setting, std::string words);
  bool set_title(const std::string& title);

  bool can_undo() const noexcept { return !changes_.empty(); }
  std::string undo_words() const { return changes_.empty() ? "" : changes_.back().words; }
  void undo();

  // "Can it be passed?": of what is stored now, in the background. Changing goes on meanwhile.
  void rehearse() { rehearsal_.emplace(library_.folder(), case_id_); }
  DraftRehearsal* rehearsal() noexcept { return rehearsal_ ? &*rehearsal_ : nullptr; }  // null: nobody asked
  // Whether what a rehearsal found is of the case as it is; false until its checks are through.
  bool is_of_now(const session::Rehearsal& found) const;

  // --- the CT prepared anew, for a draft of its own ---
  DraftPreparation& preparing();                                                       // begins with the first call
  const DraftPreparation* preparation() const noexcept { return preparation_.get(); }  // null: nobody asked
  std::optional<std::string> keep_preparation();  // the new draft's id; nothing: refused

  // --- from draft to published, as the commands `case review` and `case publish` ---
  void confirm_no_burned_in_text();
  void submit(const std::string& note);
  void judge(bool approve, const std::string& note);
  // Once the checks of what is stored now are through, by look.
  void publish(bool own_cohort, const std::string& note);

  // Looks whether threads have got on; once a frame.
  void look();

 private:
  struct Change {
    std::string words;
    std::function<base::Result<void>()> back;
  };
  struct Publish {
    bool own_cohort = false;
    std::string note;
  };
  bool done(const base::Result<void>& result, std::string words,
            std::function<base::Result<void>()> back = nullptr);
  void read();
  base::Result<void> publish_now(const Publish& wish);

  casedb::Library& library_;
  std::string case_id_, mentor_;
  casedb::CaseRow row_;
  std::vector<casedb::LesionRow> lesions_;
  std::vector<casedb::StructureRow> structures_;
  std::vector<casedb::Decision> decisions_;
  std::map<std::string, std::string> names_;  // of who decided, by person
  std::string locked_, refusal_, said_;
  std::vector<Change> changes_;
  std::optional<Grip> grip_;
  std::optional<cases::LesionForm> held_lesion_;  // while it is dragged
  std::optional<cases::Shape> held_shape_;
  bool drawing_ = false;
  std::optional<Publish> publish_;
  std::shared_ptr<const CheckedCase> scene_;
  DraftCase draft_case_;
  std::optional<DraftRehearsal> rehearsal_;
  std::unique_ptr<DraftPreparation> preparation_;
};

}  // namespace seldinger::app
