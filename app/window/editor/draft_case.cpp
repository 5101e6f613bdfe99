#include "app/window/editor/draft_case.h"

#include "sim/base/failure.h"

namespace seldinger::app {

DraftCase::DraftCase(std::filesystem::path library, std::string case_id)
    : library_(std::move(library)), case_id_(std::move(case_id)) {
  thread_ = std::thread([this] { run(); });
}

DraftCase::~DraftCase() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void DraftCase::look_again() {
  {
    const std::lock_guard lock(mutex_);
    ++asked_;
  }
  woken_.notify_all();
}

std::shared_ptr<const CheckedCase> DraftCase::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

bool DraftCase::busy() const {
  const std::lock_guard lock(mutex_);
  return answered_ != asked_;
}

std::optional<base::Error> DraftCase::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

base::Result<std::shared_ptr<const CheckedCase>> DraftCase::make(casedb::Library& library, std::uint64_t number) {
  std::string mark = casedb::content_mark(library, case_id_);
  auto row = casedb::find_case(library, case_id_);
  if (!row) return row.error();
  if (!assets_) {
    auto loaded = session::load_assets(library, *row, session::Needs::touch);
    if (!loaded) return loaded.error();
    assets_ = std::move(*loaded);
  }
  const auto lesions = casedb::list_lesions(library, case_id_);
  const auto structures = casedb::list_structures(library, case_id_);
  cases::Picture picture;
  picture.modality = row->modality;
  auto scene = session::build_case(library, *row, *assets_, std::nullopt, picture, session::Needs::touch);
  if (!scene) return scene.error();
  auto made = std::make_shared<CheckedCase>();
  made->number = number;
  made->scene = std::move(*scene);
  made->check = session::check_loaded_case(std::move(mark), made->scene, *row, lesions, structures);
  for (const casedb::LesionRow& lesion : lesions) session::add_lesion(lesion.form, made->scene);
  made->way = session::planned_way(made->scene);
  made->row = std::move(*row);
  return std::shared_ptr<const CheckedCase>(std::move(made));
}

void DraftCase::run() {
  std::optional<casedb::Library> library;
  for (std::uint64_t number = 1;; ++number) {
    std::uint64_t asked = 0;
    {
      std::unique_lock lock(mutex_);
      woken_.wait(lock, [this] { return stopping_ || answered_ != asked_; });
      if (stopping_) return;
      asked = asked_;
    }
    std::shared_ptr<const CheckedCase> made;
    std::optional<base::Error> error;
    try {
      if (!library) {
        auto opened = casedb::Library::open(library_);
        if (opened)
          library.emplace(std::move(*opened));
        else
          error = opened.error();
      }
      if (library) {
        auto answer = make(*library, number);
        if (answer)
          made = std::move(*answer);
        else
          error = answer.error();
      }
    } catch (const base::Failure& failure) {
      error = base::Error{failure.code(), failure.what()};
    }
    const std::lock_guard lock(mutex_);
    if (made) newest_ = std::move(made);
    error_ = std::move(error);
    answered_ = asked;
  }
}

}  // namespace seldinger::app
