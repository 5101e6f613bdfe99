// A small picture of each case that is listed: its CT, axially through its target. Made on a thread of its own, one
// after the other, as long as they are wanted: a CT takes a moment to be loaded.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <glm/vec2.hpp>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "casedb/database/library.h"

namespace seldinger::app {

struct CaseThumbnail {
  static constexpr int kSidePx = 64;
  std::vector<unsigned char> grey;     // kSidePx · kSidePx, the upper row (anterior) first
  std::optional<glm::dvec2> target{};  // from the upper left, as shares of the side
};

class CaseThumbnails {
 public:
  explicit CaseThumbnails(std::filesystem::path library) : library_(std::move(library)) {}
  ~CaseThumbnails();
  CaseThumbnails(const CaseThumbnails&) = delete;
  CaseThumbnails& operator=(const CaseThumbnails&) = delete;

  // These and no others, in this order; those that are made already stay. None: it rests.
  void want(std::vector<std::string> case_ids);
  void forget(const std::string& case_id);  // it may have changed
  // Null: not yet, or there is none.
  std::shared_ptr<const CaseThumbnail> of(const std::string& case_id) const;

 private:
  void run();

  const std::filesystem::path library_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> wanted_;
  std::map<std::string, std::shared_ptr<const CaseThumbnail>> made_;  // null: it cannot be
  bool gone_ = false;
  std::thread thread_;  // begun by the first wish
};

// Of one case. `no_case`, or why its CT cannot be read.
base::Result<CaseThumbnail> make_thumbnail(casedb::Library& library, const std::string& case_id);

}  // namespace seldinger::app
