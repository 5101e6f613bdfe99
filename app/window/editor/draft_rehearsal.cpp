#include "app/window/editor/draft_rehearsal.h"

#include <utility>

#include "sim/base/failure.h"

namespace seldinger::app {

DraftRehearsal::DraftRehearsal(std::filesystem::path library, std::string case_id) {
  thread_ =
      std::thread([this, library = std::move(library), case_id = std::move(case_id)] { run(library, case_id); });
}

DraftRehearsal::~DraftRehearsal() {
  stop();
  thread_.join();
}

DraftRehearsal::Now DraftRehearsal::now() const {
  const std::lock_guard lock(mutex_);
  return now_;
}

void DraftRehearsal::run(const std::filesystem::path& folder, const std::string& case_id) {
  session::RehearsalWish wish;
  wish.told = [this](std::size_t made, std::size_t of) {
    const std::lock_guard lock(mutex_);
    now_.made = made;
    now_.of = of;
    return !stopping_;
  };
  std::optional<base::Result<session::Rehearsal>> found;
  try {
    auto library = casedb::Library::open(folder);
    if (library)
      found.emplace(session::rehearse(*library, case_id, wish));
    else
      found.emplace(library.error());
  } catch (const base::Failure& failure) {
    found.emplace(base::Error{failure.code(), failure.what()});
  }
  const std::lock_guard lock(mutex_);
  if (*found)
    now_.found = std::move(**found);
  else
    now_.error = found->error();
  now_.running = false;
}

}  // namespace seldinger::app
