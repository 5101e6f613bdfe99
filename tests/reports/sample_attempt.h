// An attempt to show, for the tests of pages.
#pragma once

#include "reports/words/attempt_words.h"

namespace seldinger::reports {

inline AttemptView sample_attempt() {
  AttemptView view;
  casedb::AttemptRow& row = view.row;
  row.attempt_id = "0190a1b2-0000-7000-8000-0000000000a1";
  row.case_id = "0190a1b2-0000-7000-8000-0000000000c1";
  row.case_title = "Liver, segment VI";
  row.lesion_id = "0190a1b2-0000-7000-8000-0000000000b1";
  row.operator_name = "expert";
  row.program_version = "0.1.0";
  row.picture_sha256 = std::string(64, 'a');
  row.seed = 7;
  row.lesion = {{12.0, -34.54, 100.0}, 8.0, 20.0};
  row.started_us = 1772373909000000;  // 2026-03-01 14:05:09 UTC
  row.duration_s = 34.56;
  row.step_version = 3;
  row.metrics = {{"hit", 1, 1.0, "bool", ""},
                 {"tip_target_dist", 1, 2.34, "mm", ""},
                 {"tip_target_axial", 1, -1.26, "mm", ""},
                 {"core_in_target", 1, std::nullopt, "mm", "not_a_core_needle"},
                 {"time_total", 2, 31.25, "s", ""},
                 {"vis_joint", 1, 0.424, "share", ""},
                 {"skin_punctures", 1, 1.0, "count", ""}};
  view.operator_label = "Simulated expert";
  return view;
}

// A needle that goes straight to the target in `seconds`, seen in the second half.
inline cases::Recording sample_recording(const cases::Lesion& lesion, double seconds) {
  cases::Recording recording;
  const int samples = static_cast<int>(100.0 * seconds) + 1;
  for (int i = 0; i < samples; ++i) {
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = lesion.center_lps_mm + glm::dvec3(0.0, 60.0 * (1.0 - pose.t_s / seconds), 0.0);
    recording.poses.push_back(pose);
  }
  for (int i = 0; i < static_cast<int>(30.0 * seconds); ++i) {
    cases::FrameTruth frame;
    frame.t_s = i / 30.0;
    frame.needle_tip = frame.t_s >= 0.5 * seconds;
    recording.frames.push_back(frame);
  }
  recording.endpoint = cases::Endpoint{seconds, lesion.center_lps_mm, {0.0, 0.0, 1.0}};
  return recording;
}

}  // namespace seldinger::reports
