// The sentence that every screen, page, film, kept picture, exported mesh and printed answer shows: one text for a
// safety notice.
#pragma once

namespace seldinger::base {

inline constexpr const char* kTrainingOnly = "Training only, not for planning a patient's procedure.";

}  // namespace seldinger::base
