#include "app/window/trainer/case_import.h"

#include <utility>

#include "app/cases/import_case.h"
#include "casedb/import/ct_rules.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

base::Result<CaseImport::Made> make(const std::filesystem::path& folder, const std::string& person_id,
                                    const CaseImport::Wish& wish) {
  auto library = casedb::Library::open(folder);
  if (!library) return library.error();
  library->act_for(casedb::Actor::person(person_id));
  auto imported = import_case(wish.source, std::nullopt, wish.title, "import");
  if (!imported) return imported.error();
  imported->modality = wish.modality;
  if (wish.modality == cases::Modality::xray)
    if (auto thin = casedb::thin_slab(imported->volume)) imported->warnings.push_back(std::move(*thin));
  CaseImport::Made made;
  made.case_id = casedb::add_case(*library, *imported);
  const auto row = casedb::find_case(*library, made.case_id);
  if (!row) return row.error();
  made.title = row->title;
  for (const casedb::CaseRow& other : casedb::list_case_heads(*library))
    if (other.case_id != made.case_id && other.volume_sha256 == row->volume_sha256)
      made.same_ct.push_back("“" + other.title + "”, version " + std::to_string(other.version));
  return made;
}

}  // namespace

CaseImport::CaseImport(std::filesystem::path library, std::string person_id, Wish wish)
    : person_id_(std::move(person_id)) {
  thread_ = std::thread([this, library = std::move(library), wish = std::move(wish)] {
    std::optional<base::Result<Made>> made;
    try {
      made.emplace(make(library, person_id_, wish));
    } catch (const base::Failure& failure) {
      made.emplace(base::Error{failure.code(), failure.what()});
    }
    const std::lock_guard lock(mutex_);
    made_ = std::move(made);
  });
}

CaseImport::~CaseImport() {
  thread_.join();
}

std::optional<base::Result<CaseImport::Made>> CaseImport::made() const {
  const std::lock_guard lock(mutex_);
  return made_;
}

}  // namespace seldinger::app
