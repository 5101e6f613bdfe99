// A case's CT prepared anew, for a mentor to look at beside the CT as it came: what the settings in hand make of
// it, worked out by a thread, as import would make it of the same CT.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "app/window/editor/draft_case.h"
#include "app/window/editor/hu_histogram.h"
#include "casedb/cases/versions.h"
#include "casedb/import/prepare.h"

namespace seldinger::app {

struct PreparedDraft {
  casedb::Preparation settings;
  std::shared_ptr<const CheckedCase> shown;  // volume and skin; nothing is checked, nothing placed in it
  casedb::Fidelity fidelity;
  std::vector<base::Problem> warnings;  // that import would keep
};

class DraftPreparation {
 public:
  // Begins at once, with what is stored of the case: `settings` are those, or as import prepares by itself.
  DraftPreparation(std::filesystem::path library, casedb::CaseRow row, const casedb::Preparation& stored);
  ~DraftPreparation();
  DraftPreparation(const DraftPreparation&) = delete;
  DraftPreparation& operator=(const DraftPreparation&) = delete;

  // What is wished; wishes that are passed by a later one before they are begun are left out.
  void wish(const casedb::Preparation& settings);
  const casedb::Preparation& settings() const noexcept { return settings_; }
  const casedb::Preparation& stored() const noexcept { return stored_; }

  std::shared_ptr<const PreparedDraft> newest() const;   // nothing before the first
  std::shared_ptr<const CheckedCase> original() const;   // the CT as it came, with the skin that import makes
  std::shared_ptr<const HuHistogram> histogram() const;  // of that
  bool busy() const;                                     // what was wished last is not there yet
  std::optional<base::Error> error() const;              // why what was wished last cannot be

  // The newest as a draft of its own; refused while it is not what is wished. Answers its id.
  base::Result<std::string> keep(casedb::Library& library, const std::string& by) const;

 private:
  void run();
  bool stopping() const;
  base::Result<void> load();
  void show_original();
  base::Result<std::shared_ptr<const PreparedDraft>> make(const casedb::Preparation& settings);
  std::shared_ptr<const CheckedCase> shown_of(casedb::Prepared prepared);

  const std::filesystem::path library_;
  const casedb::CaseRow row_;
  const casedb::Preparation stored_;
  casedb::Preparation settings_;  // the window's
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  casedb::Preparation asked_;
  bool waiting_ = true, working_ = false, stopping_ = false;
  std::shared_ptr<const PreparedDraft> newest_;
  std::shared_ptr<const CheckedCase> original_;
  std::shared_ptr<const HuHistogram> histogram_;
  std::optional<base::Error> error_;
  // The thread's.
  std::uint64_t number_;
  volume::Volume came_;
  std::optional<casedb::FullSurface> full_;
  double full_hu_ = 0.0;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::app
