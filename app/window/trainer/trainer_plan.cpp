// The trainee's own: the plan of the way in, and how attempt follows on attempt.
#include <algorithm>
#include <glm/geometric.hpp>

#include "app/window/trainer/trainer.h"
#include "session/case/planned_way.h"

namespace seldinger::app {
namespace {

constexpr std::size_t kShownAttempts = 20;
constexpr double kLeastWayMm = 1.0;  // what is shorter has no direction that anybody meant

// Where a needle is fired on its way into the target: a core needle at its edge, for it is thrown through it.
glm::dvec3 firing_place(const session::Task& task, const session::PlannedWay& way) {
  if (task.scene.instrument.kind != cases::InstrumentKind::core) return way.target_lps_mm;
  const glm::dvec3 direction = (way.target_lps_mm - way.entry_lps_mm) / way.length_mm;
  return way.target_lps_mm - std::min(task.lesion.lesion.radius_mm, 0.5 * way.length_mm) * direction;
}

}  // namespace

const session::Task* Trainer::planned_task() const {
  if (screen_ != TrainerScreen::briefing || resuming_ || !attempt_ ||
      attempt_->phase() != PersonAttempt::Phase::ready)
    return nullptr;
  return attempt_->task().get();  // the attempt keeps it
}

void Trainer::put_plan(const assessment::PlannedPath& path) {
  if (path.depth_mm() >= kLeastWayMm) plan_ = path;
}

// What is not planned yet is as the case proposes, or the target itself.
void Trainer::plan_entry(const glm::dvec3& place_lps_mm) {
  const session::Task* task = planned_task();
  if (task == nullptr || task->scene.skin_index.empty()) return;
  const glm::dvec3 entry = task->scene.skin_index.closest_skin(place_lps_mm).point_lps_mm;
  put_plan({entry, plan_ ? plan_->tip_lps_mm : task->lesion.lesion.center_lps_mm});
}

void Trainer::plan_tip(const glm::dvec3& place_lps_mm) {
  const session::Task* task = planned_task();
  if (task == nullptr || task->scene.skin_index.empty()) return;
  const glm::dvec3 entry =
      plan_ ? plan_->entry_lps_mm : task->scene.skin_index.closest_skin(place_lps_mm).point_lps_mm;
  put_plan({entry, place_lps_mm});
}

bool Trainer::proposes_path() const {
  const session::Task* task = planned_task();
  return task != nullptr && task->scene.planned_entry_lps_mm && !task->scene.lesions.empty();
}

void Trainer::plan_as_proposed() {
  const session::Task* task = planned_task();
  if (task == nullptr) return;
  if (const auto way = session::planned_way(task->scene)) put_plan({way->entry_lps_mm, firing_place(*task, *way)});
}

std::vector<OwnAttempt> Trainer::own_attempts() {
  casedb::Grader grader(library_);
  std::vector<OwnAttempt> own;
  for (const casedb::AttemptRow& row : casedb::list_attempts_of(library_, account_.person_id)) {
    if (row.case_id != chosen_.case_id || row.synthetic()) continue;
    own.push_back({row.attempt_id, row.duration_s, grader.grade(row)});
    if (own.size() == kShownAttempts) break;
  }
  std::reverse(own.begin(), own.end());
  return own;
}

}  // namespace seldinger::app
