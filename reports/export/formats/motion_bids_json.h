// Attempts as a Motion-BIDS data set (BIDS 1.9, Jeung et al., Sci. Data 11, 2024): where the needle was, 100 rows a
// second, with what says what the columns are.
#pragma once

#include <string>
#include <vector>

#include "reports/export/formats/format_file.h"
#include "sim/case/record/recording.h"

namespace seldinger::reports {

// "sub-PA12B": labels have letters and digits alone.
std::string bids_subject(const std::string& person);
// motion-bids/sub-…/motion/: *_motion.tsv, *_motion.json, *_channels.tsv, *_channels.json of an attempt.
std::vector<FormatFile> motion_bids_files(const std::string& person, const std::string& attempt,
                                          const cases::Recording& recording);
// motion-bids/: dataset_description.json, participants.tsv, README, of these subjects.
std::vector<FormatFile> motion_bids_head(const std::vector<std::string>& subjects);

}  // namespace seldinger::reports
