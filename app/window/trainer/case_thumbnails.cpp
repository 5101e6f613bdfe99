#include "app/window/trainer/case_thumbnails.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <utility>

#include "casedb/cases/cases.h"
#include "sim/base/failure.h"
#include "sim/imaging/mpr/mpr.h"

namespace seldinger::app {
namespace {

constexpr double kWindowCenterHu = 40.0, kWindowWidthHu = 400.0;  // soft tissue

}  // namespace

base::Result<CaseThumbnail> make_thumbnail(casedb::Library& library, const std::string& case_id) {
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  const auto volume = casedb::load_volume(library, *row);
  if (!volume) return volume.error();
  const auto at = [&](double share) {
    const glm::dvec3 voxel = share * glm::dvec3(volume->size_voxels - 1);
    return glm::dvec3(volume->lps_from_voxel * glm::dvec4(voxel, 1.0));
  };
  const glm::dvec3 one = at(0.0), other = at(1.0), size_mm = glm::abs(other - one);
  const double side_mm = std::max(size_mm.x, size_mm.y);
  imaging::MprView view;
  view.center_lps_mm = 0.5 * (one + other);
  view.u = {1.0, 0.0, 0.0};
  view.v = {0.0, 1.0, 0.0};
  view.width_px = view.height_px = CaseThumbnail::kSidePx;
  view.pixel_mm = side_mm / CaseThumbnail::kSidePx;
  CaseThumbnail made;
  std::vector<cases::Lesion> lesions;
  for (const casedb::LesionRow& lesion : casedb::list_lesions(library, case_id)) lesions.push_back(lesion.lesion);
  if (!lesions.empty()) {
    const glm::dvec3& target = lesions.front().center_lps_mm;
    view.center_lps_mm.z = target.z;
    made.target = (glm::dvec2(target) - glm::dvec2(view.center_lps_mm)) / side_mm + 0.5;
  }
  made.grey = imaging::grey_from_hu(imaging::mpr_cpu(*volume, view, {std::nullopt, lesions}), kWindowCenterHu,
                                    kWindowWidthHu);
  return made;
}

CaseThumbnails::~CaseThumbnails() {
  {
    const std::lock_guard lock(mutex_);
    gone_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void CaseThumbnails::want(std::vector<std::string> case_ids) {
  {
    const std::lock_guard lock(mutex_);
    wanted_ = std::move(case_ids);
    if (!thread_.joinable() && !wanted_.empty()) thread_ = std::thread([this] { run(); });
  }
  changed_.notify_all();
}

void CaseThumbnails::forget(const std::string& case_id) {
  const std::lock_guard lock(mutex_);
  made_.erase(case_id);
}

std::shared_ptr<const CaseThumbnail> CaseThumbnails::of(const std::string& case_id) const {
  const std::lock_guard lock(mutex_);
  const auto found = made_.find(case_id);
  return found == made_.end() ? nullptr : found->second;
}

void CaseThumbnails::run() {
  std::unique_lock lock(mutex_);
  const auto next = [this] {
    return std::find_if(wanted_.begin(), wanted_.end(),
                        [this](const std::string& id) { return !made_.contains(id); });
  };
  for (;;) {
    changed_.wait(lock, [&] { return gone_ || next() != wanted_.end(); });
    if (gone_) return;
    const std::string case_id = *next();
    lock.unlock();
    std::shared_ptr<const CaseThumbnail> made;
    try {
      auto library = casedb::Library::open(library_);
      if (library)
        if (auto thumbnail = make_thumbnail(*library, case_id))
          made = std::make_shared<const CaseThumbnail>(std::move(*thumbnail));
    } catch (const base::Failure&) {
      // A list without this picture is a list.
    }
    lock.lock();
    made_[case_id] = std::move(made);
  }
}

}  // namespace seldinger::app
