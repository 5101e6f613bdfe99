// "Can it be passed?": a stored case rehearsed by simulated operators on a thread of its own, while the case editor
// goes on. One thread only: the window has the other processor.
#pragma once

#include <atomic>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "session/attempt/rehearsal.h"

namespace seldinger::app {

class DraftRehearsal {
 public:
  struct Now {
    bool running = true;
    std::size_t made = 0, of = 0;  // of: 0 until the case is prepared
    std::optional<session::Rehearsal> found;
    std::optional<base::Error> error;
  };

  // Begins at once.
  DraftRehearsal(std::filesystem::path library, std::string case_id);
  ~DraftRehearsal();  // stops it
  DraftRehearsal(const DraftRehearsal&) = delete;
  DraftRehearsal& operator=(const DraftRehearsal&) = delete;

  Now now() const;
  void stop() noexcept { stopping_ = true; }  // what is known by then is found
  bool stopping() const noexcept { return stopping_; }

 private:
  void run(const std::filesystem::path& library, const std::string& case_id);

  mutable std::mutex mutex_;
  Now now_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::app
