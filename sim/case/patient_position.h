// How the patient lies on the table.
#pragma once

namespace seldinger::cases {

enum class PatientPosition { supine, prone };

}  // namespace seldinger::cases
