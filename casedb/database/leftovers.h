// What a killed process left of its NewFile or NewFolder under a name that no later run takes again, as yesterday's
// backup. Only what bears such a name, belongs to this user, holds nothing but what the caller knows as its own,
// and whose writer is gone: its lock, which the kernel takes back with the process, is free. What cannot be looked
// at or removed stays, without a word.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace seldinger::casedb {

// Files that begin with `magic`, or with as much of it as was written.
void remove_leftover_files(const std::filesystem::path& folder, std::string_view magic);

// `is_ours` is asked of each name in it, relative to it; an empty one stays, since somebody may be about to lock
// it.
void remove_leftover_folders(const std::filesystem::path& folder,
                             const std::function<bool(const std::string& name)>& is_ours);

}  // namespace seldinger::casedb
