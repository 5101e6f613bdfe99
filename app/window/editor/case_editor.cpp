#include "app/window/editor/case_editor.h"

#include "casedb/people/people.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "casedb/cases/changeable_case.h"

namespace seldinger::app {
namespace {

constexpr std::size_t kMostChanges = 200;  // that can be undone

void set_middle(const glm::dvec3& place, cases::Shape& shape) {
  if (auto* sphere = std::get_if<cases::Sphere>(&shape)) sphere->center_lps_mm = place;
  if (auto* ellipsoid = std::get_if<cases::Ellipsoid>(&shape)) ellipsoid->center_lps_mm = place;
  if (auto* tube = std::get_if<cases::Tube>(&shape)) tube->points_lps_mm = {place};
}

}  // namespace

std::optional<glm::dvec3> skin_under(const cases::Case& scene, const glm::dvec3& eye_lps_mm, const glm::dvec3& ray,
                                     const std::optional<imaging::CutPlane>& cut) {
  constexpr double kFarMm = 5000.0, kPastMm = 0.01;
  double gone_mm = 0.0;
  while (!scene.skin_index.empty()) {
    const auto hit = scene.skin_index.first_hit(eye_lps_mm + ray * gone_mm, ray, kFarMm - gone_mm);
    if (!hit) return std::nullopt;
    gone_mm += hit->distance_mm + kPastMm;
    const glm::dvec3 place = eye_lps_mm + ray * (gone_mm - kPastMm);
    if (cut && glm::dot(cut->normal, place) > cut->distance_mm) continue;
    if (hit->cut || glm::dot(scene.skin_index.normal(hit->triangle), ray) > 0.0) return std::nullopt;
    return place;
  }
  return std::nullopt;
}

glm::dvec3 first_look(const cases::Case& scene, const std::vector<casedb::LesionRow>& lesions,
                      const glm::dvec3& up) {
  constexpr double kAboveMm = 1000.0;  // higher than any patient
  if (scene.planned_entry_lps_mm) return *scene.planned_entry_lps_mm;
  if (!lesions.empty()) return scene.skin_index.closest_skin(lesions.front().lesion.center_lps_mm).point_lps_mm;
  const glm::dvec3 middle(scene.volume.lps_from_voxel *
                          glm::dvec4(glm::dvec3(scene.volume.size_voxels - 1) / 2.0, 1.0));
  return scene.skin_index.closest_skin(middle + kAboveMm * up).point_lps_mm;
}

CaseEditor::CaseEditor(casedb::Library& library, const std::string& case_id, std::string mentor)
    : library_(library), case_id_(case_id), mentor_(std::move(mentor)), draft_case_(library.folder(), case_id) {
  new_lesion.radii_mm = glm::dvec3(8.0);
  new_lesion.hu = 20.0;
  new_structure.case_id = case_id;
  new_structure.name = "structure 1";
  new_structure.rule = cases::StructureRule::critical;
  new_structure.tissue = volume::TissueClass::vessel;
  new_structure.hu = volume::typical_hu(new_structure.tissue);
  new_structure.drawn = cases::Sphere{{}, 6.0};
  read();
  structure = structures_.size();
}

void CaseEditor::read() {
  if (auto row = casedb::find_case(library_, case_id_))
    row_ = std::move(*row);
  else
    refusal_ = row.error().text;
  lesions_ = casedb::list_lesions(library_, case_id_);
  structures_ = casedb::list_structures(library_, case_id_);
  decisions_ = casedb::list_decisions(library_, case_id_);
  for (const casedb::Account& one : casedb::list_users(library_)) names_[one.person_id] = one.login_name;
  const auto changeable = casedb::changeable_case(library_, case_id_);
  locked_ = changeable ? "" : changeable.error().text;
  lesion = std::min(lesion, lesions_.size());
  structure = std::min(structure, structures_.size());
}

std::string CaseEditor::who(const casedb::Decision& decision) const {
  const auto& self = library_.actor().person_id;
  if (self && *self == decision.person_id) return "you";
  const auto name = names_.find(decision.person_id);
  casedb::Decision named = decision;
  if (name != names_.end()) named.pseudonym = name->second;
  return named.who();
}

bool CaseEditor::done(const base::Result<void>& result, std::string words,
                      std::function<base::Result<void>()> back) {
  const bool stored = result.has_value();
  refusal_ = stored ? "" : result.error().text;
  read();
  if (!stored) return false;
  said_ = words;
  if (back) {
    if (changes_.size() == kMostChanges) changes_.erase(changes_.begin());
    changes_.push_back({std::move(words), std::move(back)});
  }
  draft_case_.look_again();
  return true;
}

void CaseEditor::look() {
  const bool busy = draft_case_.busy();  // asked first: what is newest afterwards is no older
  scene_ = draft_case_.newest();
  if (busy) return;
  if (const auto error = draft_case_.error()) refusal_ = error->text;
  if (!publish_) return;
  const Publish wish = std::exchange(publish_, std::nullopt).value();
  const bool published = done(publish_now(wish), "published");
  if (published) changes_.clear();  // what is published stays
}

std::optional<EditorSpot> CaseEditor::spot(const glm::dvec3& place) const {
  if (!scene_) return std::nullopt;
  const cases::Case& scene = scene_->scene;
  EditorSpot spot;
  const glm::dvec3 index(volume::voxel_from_lps(scene.volume) * glm::dvec4(place, 1.0));
  spot.hu = volume::sample_trilinear(scene.volume, index);
  if (!spot.hu) return spot;
  const glm::dvec3 last(scene.volume.size_voxels - 1);
  const glm::ivec3 at(glm::clamp(glm::floor(index + 0.5), glm::dvec3(0.0), last));
  spot.tissue = scene.classes[scene.volume.index(at.x, at.y, at.z)];
  for (std::size_t i = 0; i < scene.lesions.size(); ++i)
    if (cases::signed_distance_mm(cases::shape_of(scene.lesions[i]), place, 0.01) < 0.0) {
      spot.in.push_back("lesion " + std::to_string(i + 1));
      if (!scene.lesions[i].in_volume()) spot.hu = scene.lesions[i].hu;  // pictures draw it
    }
  for (const cases::Structure& one : scene.structures)
    if (cases::signed_distance_mm(one.shape, place, 0.01) < 0.0) spot.in.push_back(one.name);
  if (!scene.skin_index.empty()) spot.depth_mm = -scene.skin_index.closest(place).distance_mm;
  return spot;
}

bool CaseEditor::grab(std::size_t plane, const glm::dvec3& place, double reach_mm) {
  grip_.reset();
  if (!locked_.empty()) return false;
  const PlaneKind& kind = plane_kinds().at(plane);
  if (tool == EditorTool::lesion) {
    // The chosen one first, then whichever is there.
    for (std::size_t tried = 0; tried <= lesions_.size() && !grip_; ++tried) {
      const std::size_t at = tried == 0 ? lesion : tried - 1;
      if (at >= lesions_.size()) continue;
      grip_ = grip_of(lesions_[at].form, kind, place, reach_mm);
      if (!grip_) continue;
      lesion = at;
      held_lesion_ = lesions_[at].form;
    }
  } else if (tool == EditorTool::structure) {
    if (drawing_) {
      grip_ = grip_of(new_structure.drawn, kind, place, reach_mm);
      if (grip_) held_shape_ = new_structure.drawn;
      return grip_.has_value();
    }
    for (std::size_t tried = 0; tried <= structures_.size() && !grip_; ++tried) {
      const std::size_t at = tried == 0 ? structure : tried - 1;
      if (at >= structures_.size() || structures_[at].kind != casedb::StructureKind::drawn) continue;
      grip_ = grip_of(structures_[at].drawn, kind, place, reach_mm);
      if (!grip_) continue;
      structure = at;
      held_shape_ = structures_[at].drawn;
    }
  }
  return grip_.has_value();
}

void CaseEditor::drag(std::size_t plane, const glm::dvec3& place) {
  if (!grip_) return;
  const PlaneKind& kind = plane_kinds().at(plane);
  if (held_lesion_) app::drag(*grip_, kind, place, *held_lesion_);
  if (held_shape_) app::drag(*grip_, kind, place, *held_shape_);
}

void CaseEditor::let_go() {
  grip_.reset();
  if (const auto form = std::exchange(held_lesion_, std::nullopt)) put_lesion(lesion, *form);
  if (auto shape = std::exchange(held_shape_, std::nullopt)) {
    if (drawing_) {
      new_structure.drawn = std::move(*shape);
      return;
    }
    casedb::StructureRow changed = structures_.at(structure);
    changed.drawn = std::move(*shape);
    put_structure(structure, changed);
  }
}

void CaseEditor::drop_grip() noexcept {
  grip_.reset();
  held_lesion_.reset();
  held_shape_.reset();
}

void CaseEditor::click(const glm::dvec3& place) {
  if (!scene_) return;
  view.set_cursor(scene_->scene.volume, place);
  if (tool == EditorTool::look || tool == EditorTool::rule || tool == EditorTool::prepare) return;
  if (!locked_.empty()) {
    refusal_ = locked_;
    return;
  }
  if (tool == EditorTool::lesion) {
    cases::LesionForm form = lesion < lesions_.size() ? lesions_[lesion].form : new_lesion;
    form.center_lps_mm = place;
    put_lesion(lesion, form);
  } else if (tool == EditorTool::structure) {
    if (structure < structures_.size()) {
      casedb::StructureRow changed = structures_[structure];
      if (changed.kind != casedb::StructureKind::drawn) return;
      if (auto* tube = std::get_if<cases::Tube>(&changed.drawn))
        tube->points_lps_mm.push_back(place);
      else
        set_middle(place, changed.drawn);
      put_structure(structure, changed);
    } else if (new_structure.kind != casedb::StructureKind::drawn) {
      return;
    } else if (auto* tube = std::get_if<cases::Tube>(&new_structure.drawn)) {
      if (!drawing_) tube->points_lps_mm.clear();
      drawing_ = true;
      tube->points_lps_mm.push_back(place);
    } else {
      set_middle(place, new_structure.drawn);
      add_structure(new_structure);
    }
  } else if (tool == EditorTool::entry) {
    set_entry(place);
  }
}

void CaseEditor::finish_drawing() {
  if (!drawing_) return;
  if (add_structure(new_structure)) drop_drawing();
}

void CaseEditor::drop_drawing() {
  drawing_ = false;
  if (auto* tube = std::get_if<cases::Tube>(&new_structure.drawn)) tube->points_lps_mm.clear();
}

std::vector<cases::LesionForm> CaseEditor::shown_lesions() const {
  std::vector<cases::LesionForm> shown;
  for (std::size_t i = 0; i < lesions_.size(); ++i)
    shown.push_back(held_lesion_ && i == lesion ? *held_lesion_ : lesions_[i].form);
  return shown;
}

std::vector<casedb::StructureRow> CaseEditor::shown_structures() const {
  std::vector<casedb::StructureRow> shown = structures_;
  if (drawing_) shown.push_back(new_structure);
  if (held_shape_) (drawing_ ? shown.back() : shown.at(structure)).drawn = *held_shape_;
  return shown;
}

bool CaseEditor::put_lesion(std::size_t index, const cases::LesionForm& form) {
  if (index >= lesions_.size()) {
    const auto made = casedb::add_lesion(library_, case_id_, form);
    if (!made) return done(made.error(), "");
    lesion = lesions_.size();
    return done({}, "lesion placed", [this, id = *made] { return casedb::remove_lesion(library_, case_id_, id); });
  }
  const casedb::LesionRow before = lesions_[index];
  casedb::LesionRow after = before;
  after.form = form;
  return done(casedb::put_lesion(library_, after), "lesion changed",
              [this, before] { return casedb::put_lesion(library_, before); });
}

bool CaseEditor::remove_lesion(std::size_t index) {
  if (index >= lesions_.size()) return false;
  const casedb::LesionRow before = lesions_[index];
  return done(casedb::remove_lesion(library_, case_id_, before.lesion_id), "lesion removed",
              [this, before] { return casedb::put_lesion(library_, before); });
}

bool CaseEditor::add_structure(const casedb::StructureRow& made) {
  const auto structure_id = casedb::add_structure(library_, made);
  if (!structure_id) return done(structure_id.error(), "");
  structure = structures_.size();
  const bool stored = done({}, "“" + made.name + "” added",
                           [this, name = made.name] { return casedb::remove_structure(library_, case_id_, name); });
  // A name for the next.
  const auto taken = [&](const std::string& name) {
    return std::any_of(structures_.begin(), structures_.end(),
                       [&](const casedb::StructureRow& one) { return one.name == name; });
  };
  for (std::size_t number = structures_.size() + 1; taken(new_structure.name); ++number)
    new_structure.name = "structure " + std::to_string(number);
  return stored;
}

bool CaseEditor::put_structure(std::size_t index, const casedb::StructureRow& changed) {
  if (index >= structures_.size()) return false;
  const casedb::StructureRow before = structures_[index];
  return done(casedb::put_structure(library_, changed), "“" + changed.name + "” changed",
              [this, before] { return casedb::put_structure(library_, before); });
}

bool CaseEditor::remove_structure(std::size_t index) {
  if (index >= structures_.size()) return false;
  const casedb::StructureRow before = structures_[index];
  return done(casedb::remove_structure(library_, case_id_, before.name), "“" + before.name + "” removed",
              [this, before] { return casedb::put_structure(library_, before); });
}

bool CaseEditor::set_entry(const std::optional<glm::dvec3>& place) {
  casedb::CaseSetting setting = row_;
  setting.planned_entry_lps_mm = place;
  if (place && scene_ && !scene_->scene.skin_index.empty())
    setting.planned_entry_lps_mm = scene_->scene.skin_index.closest_skin(*place).point_lps_mm;
  return set_setting(setting, place ? "entry placed" : "entry removed");
}

bool CaseEditor::set_setting(const casedb::CaseSetting& setting, std::string words) {
  const casedb::CaseSetting before = row_;
  return done(casedb::set_setting(library_, case_id_, setting), std::move(words),
              [this, before] { return casedb::set_setting(library_, case_id_, before); });
}

bool CaseEditor::set_title(const std::string& title) {
  return done(casedb::set_title(library_, case_id_, title), "title changed",
              [this, before = row_.title] { return casedb::set_title(library_, case_id_, before); });
}

void CaseEditor::undo() {
  if (changes_.empty()) return;
  const Change change = std::move(changes_.back());
  changes_.pop_back();
  done(change.back(), "undone: " + change.words);
}

bool CaseEditor::is_of_now(const session::Rehearsal& found) const {
  return scene_ && !checking() && scene_->check.content_mark == found.content_mark;
}

DraftPreparation& CaseEditor::preparing() {
  if (!preparation_) {
    const auto stored = casedb::find_preparation(library_.database(), case_id_);
    preparation_ = std::make_unique<DraftPreparation>(library_.folder(), row_,
                                                      stored ? stored->settings : casedb::Preparation{});
  }
  return *preparation_;
}

std::optional<std::string> CaseEditor::keep_preparation() {
  const auto made = preparing().keep(library_, mentor_);
  refusal_ = made ? "" : made.error().text;
  return made ? std::optional(*made) : std::nullopt;
}

void CaseEditor::confirm_no_burned_in_text() {
  std::optional<std::string> person_id;
  for (const casedb::Account& one : casedb::list_users(library_))
    if (one.login_name == mentor_) person_id = one.person_id;
  done(casedb::confirm_no_burned_in_text(library_, case_id_, person_id), "confirmed: no text in the pictures");
}

void CaseEditor::submit(const std::string& note) {
  done(casedb::submit_case(library_, case_id_, mentor_, note), "in review");
}

void CaseEditor::judge(bool approve, const std::string& note) {
  done(casedb::judge_case(library_, case_id_, mentor_, approve, note), approve ? "approved" : "returned to draft");
}

void CaseEditor::publish(bool own_cohort, const std::string& note) {
  publish_ = Publish{own_cohort, note};
  draft_case_.look_again();
}

base::Result<void> CaseEditor::publish_now(const Publish& wish) {
  if (const auto error = draft_case_.error()) return *error;
  const casedb::CaseCheck check = scene_ ? scene_->check : casedb::CaseCheck{};  // of nothing: refused
  return casedb::publish_case(library_, case_id_, check, mentor_, wish.own_cohort, wish.note);
}

}  // namespace seldinger::app
