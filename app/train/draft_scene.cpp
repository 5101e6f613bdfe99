#include "app/train/draft_scene.h"

#include "sim/base/failure.h"

namespace seldinger::app {

DraftScene::DraftScene(std::filesystem::path library, std::string case_id)
    : library_(std::move(library)), case_id_(std::move(case_id)) {
  thread_ = std::thread([this] { run(); });
}

DraftScene::~DraftScene() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void DraftScene::look_again() {
  {
    const std::lock_guard lock(mutex_);
    ++asked_;
  }
  woken_.notify_all();
}

std::shared_ptr<const CheckedScene> DraftScene::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

bool DraftScene::busy() const {
  const std::lock_guard lock(mutex_);
  return answered_ != asked_;
}

std::optional<base::Error> DraftScene::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

base::Result<std::shared_ptr<const CheckedScene>> DraftScene::make(casedb::Library& library, std::uint64_t number) {
  std::string mark = casedb::content_mark(library, case_id_);
  auto row = casedb::find_case(library, case_id_);
  if (!row) return row.error();
  if (!assets_) {
    auto loaded = load_assets(library, *row, Needs::touch);
    if (!loaded) return loaded.error();
    assets_ = std::move(*loaded);
  }
  const auto lesions = casedb::list_lesions(library, case_id_);
  const auto structures = casedb::list_structures(library, case_id_);
  cases::Picture picture;
  picture.modality = row->modality;
  auto scene = build_case(library, *row, *assets_, std::nullopt, picture, Needs::touch);
  if (!scene) return scene.error();
  auto made = std::make_shared<CheckedScene>();
  made->number = number;
  made->scene = std::move(*scene);
  made->check = check_scene(std::move(mark), made->scene, *row, lesions, structures);
  for (const casedb::LesionRow& lesion : lesions) add_lesion(lesion.form, made->scene);
  made->way = planned_way(made->scene);
  made->row = std::move(*row);
  return std::shared_ptr<const CheckedScene>(std::move(made));
}

void DraftScene::run() {
  std::optional<casedb::Library> library;
  for (std::uint64_t number = 1;; ++number) {
    std::uint64_t asked = 0;
    {
      std::unique_lock lock(mutex_);
      woken_.wait(lock, [this] { return stopping_ || answered_ != asked_; });
      if (stopping_) return;
      asked = asked_;
    }
    std::shared_ptr<const CheckedScene> made;
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
