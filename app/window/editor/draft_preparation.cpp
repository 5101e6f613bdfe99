#include "app/window/editor/draft_preparation.h"

#include <new>
#include <utility>

#include "casedb/cases/cases.h"
#include "session/case/case_build.h"
#include "sim/base/failure.h"
#include "sim/volume/volume_bytes.h"

namespace seldinger::app {
namespace {

// Above any that a stored case gets: pictures are told apart by them.
constexpr std::uint64_t kFirstNumber = 1'000'000'000;

// Nobody waits for it any more, and nobody is told.
base::Error left_off() {
  return {"bad_preparation", "the preparation was stopped"};
}

}  // namespace

DraftPreparation::DraftPreparation(std::filesystem::path library, casedb::CaseRow row,
                                   const casedb::Preparation& stored)
    : library_(std::move(library)),
      row_(std::move(row)),
      stored_(stored),
      settings_(stored),
      asked_(stored),
      number_(kFirstNumber) {
  thread_ = std::thread([this] { run(); });
}

DraftPreparation::~DraftPreparation() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void DraftPreparation::wish(const casedb::Preparation& settings) {
  settings_ = settings;
  {
    const std::lock_guard lock(mutex_);
    asked_ = settings;
    waiting_ = true;
  }
  woken_.notify_all();
}

std::shared_ptr<const PreparedDraft> DraftPreparation::newest() const {
  const std::lock_guard lock(mutex_);
  return newest_;
}

std::shared_ptr<const CheckedCase> DraftPreparation::original() const {
  const std::lock_guard lock(mutex_);
  return original_;
}

std::shared_ptr<const HuHistogram> DraftPreparation::histogram() const {
  const std::lock_guard lock(mutex_);
  return histogram_;
}

bool DraftPreparation::busy() const {
  const std::lock_guard lock(mutex_);
  return waiting_ || working_;
}

std::optional<base::Error> DraftPreparation::error() const {
  const std::lock_guard lock(mutex_);
  return error_;
}

base::Result<std::string> DraftPreparation::keep(casedb::Library& library, const std::string& by) const {
  const auto made = newest();
  if (busy() || !made || !(made->settings == settings_))
    return base::Error{"bad_preparation", "the CT has not been prepared like this yet"};
  const cases::Case& scene = made->shown->scene;
  return casedb::add_prepared_copy(library, row_.case_id,
                                   {scene.volume, scene.skin, made->settings, made->warnings}, by);
}

std::shared_ptr<const CheckedCase> DraftPreparation::shown_of(casedb::Prepared prepared) {
  casedb::NewCase made;
  static_cast<casedb::CaseSetting&>(made) = row_;
  made.volume = std::move(prepared.volume);
  made.skin = std::move(prepared.skin);
  auto shown = std::make_shared<CheckedCase>();
  shown->number = number_++;
  shown->row = row_;
  cases::Picture picture;
  picture.modality = row_.modality;
  shown->scene = session::build_case(made, picture, session::Needs::metrics);
  return shown;
}

bool DraftPreparation::stopping() const {
  const std::lock_guard lock(mutex_);
  return stopping_;
}

// The CT as it came, once.
base::Result<void> DraftPreparation::load() {
  auto library = casedb::Library::open(library_);
  if (!library) return library.error();
  const auto prepared_of = casedb::find_preparation(library->database(), row_.case_id);
  const auto bytes = library->load_asset(prepared_of ? prepared_of->original_sha256 : row_.volume_sha256);
  if (!bytes) return bytes.error();
  auto volume = volume::volume_from_bytes(*bytes);
  if (!volume) return volume.error();
  came_ = std::move(*volume);
  auto histogram = std::make_shared<const HuHistogram>(histogram_of(came_));
  const std::lock_guard lock(mutex_);
  histogram_ = std::move(histogram);
  return {};
}

// Where it cannot be shown, what is wished may be all the same: a skin of another value, say. It is tried again
// with the next wish.
void DraftPreparation::show_original() {
  if (original()) return;
  auto as_it_is = casedb::prepare(came_, {});
  if (!as_it_is || stopping()) return;
  auto shown = shown_of(std::move(*as_it_is));
  const std::lock_guard lock(mutex_);
  original_ = std::move(shown);
}

base::Result<std::shared_ptr<const PreparedDraft>> DraftPreparation::make(const casedb::Preparation& settings) {
  if (came_.hu.empty())
    if (const auto loaded = load(); !loaded) return loaded.error();
  if (stopping()) return left_off();
  show_original();
  if (stopping()) return left_off();
  auto prepared = casedb::prepare(came_, settings);
  if (!prepared) return prepared.error();
  if (stopping()) return left_off();
  if (!full_ || full_hu_ != settings.skin_hu) {
    auto full = casedb::full_surface(came_, settings.skin_hu);
    if (!full) return full.error();
    full_ = std::move(*full);
    full_hu_ = settings.skin_hu;
    if (stopping()) return left_off();
  }
  auto made = std::make_shared<PreparedDraft>();
  made->settings = settings;
  made->fidelity = casedb::fidelity_of(came_, *full_, *prepared);
  if (stopping()) return left_off();
  made->warnings = prepared->warnings;
  if (!(settings == casedb::Preparation{}))
    made->warnings.push_back(casedb::told_of(settings, *prepared, made->fidelity));
  made->shown = shown_of(std::move(*prepared));
  return std::shared_ptr<const PreparedDraft>(std::move(made));
}

void DraftPreparation::run() {
  for (;;) {
    casedb::Preparation settings;
    {
      std::unique_lock lock(mutex_);
      working_ = false;
      woken_.wait(lock, [this] { return stopping_ || waiting_; });
      if (stopping_) return;
      settings = asked_;
      waiting_ = false;
      working_ = true;
    }
    base::Result<std::shared_ptr<const PreparedDraft>> made = base::Error{};
    try {
      made = make(settings);
    } catch (const base::Failure& failure) {
      made = base::Error{failure.code(), failure.what()};
    } catch (const std::bad_alloc&) {
      made = base::Error{"memory", "not enough memory to prepare this CT"};
    }
    const std::lock_guard lock(mutex_);
    error_ = made ? std::nullopt : std::optional(made.error());
    if (made) newest_ = std::move(*made);
  }
}

}  // namespace seldinger::app
