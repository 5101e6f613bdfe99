// The folder of the demo's library, and who has an account in it.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "casedb/people/people.h"

namespace seldinger::app {

// The folder that a run may make a library in. Unless it is kept, it goes again with all that was put into it and
// the folders above it that were made: who is refused finds nothing. What was there before stays as it is. The
// library in it is closed before.
class MadeFolder {
 public:
  explicit MadeFolder(const std::filesystem::path& folder);
  ~MadeFolder();
  MadeFolder(const MadeFolder&) = delete;
  MadeFolder& operator=(const MadeFolder&) = delete;
  const std::filesystem::path& path() const noexcept { return path_; }
  bool holds_a_library() const;
  void keep() noexcept { kept_ = true; }

 private:
  std::filesystem::path path_, first_made_;  // empty: the folder was there
  bool was_empty_ = false, kept_ = false;
};

// Accounts that are missing get random passwords, answered by name: they are shown once.
using Passwords = std::vector<std::pair<std::string, std::string>>;
base::Result<Passwords> add_missing_accounts(casedb::Library& library,
                                             const std::vector<std::pair<const char*, casedb::Role>>& wanted);

// To standard output, at once: whoever interrupts what follows has them. Nothing if there are none.
void print_accounts(const Passwords& passwords);

// One cohort of the mentors and trainees among them, so that who leads it sees what the others did; made when there
// is none.
base::Result<void> make_demo_cohort(casedb::Library& library,
                                    const std::vector<std::pair<const char*, casedb::Role>>& accounts);

}  // namespace seldinger::app
