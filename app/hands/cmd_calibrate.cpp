// haptics calibrate: where a haptic device stands on the template, kept in the station's file.
#include <cstdio>
#include <filesystem>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/csv.h"
#include "app/cli/file.h"
#include "app/hands/station.h"

namespace seldinger::app {
namespace {

void print(const std::string& device, const devices::Calibration& calibration) {
  const devices::Placement& placement = calibration.template_from_device;
  std::printf("%s: scale %.4f, origin at (%.2f, %.2f, %.2f) mm, axes along\n", device.c_str(), placement.scale,
              placement.translation_mm.x, placement.translation_mm.y, placement.translation_mm.z);
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3& along = placement.rotation[axis];
    std::printf("  %c  (%.4f, %.4f, %.4f)\n", "xyz"[axis], along.x, along.y, along.z);
  }
  std::printf("Residuals, mm:");
  for (const devices::Calibration::Point& point : calibration.points)
    std::printf(" %s %.3f", point.taken.name.c_str(), point.residual_mm);
  std::printf("; rms %.3f, most %.3f of %g\n", calibration.residual_rms_mm, calibration.residual_max_mm,
              devices::kMostResidualMm);
}

int run_haptics_calibrate(const Arguments& arguments) {
  const std::string device = arguments.required("--device");
  if (device != "left" && device != "right") throw UsageError("--device is left or right");
  const std::filesystem::path file = arguments.required("--station");
  const auto text = read_text_of(arguments, "POINTS.csv");
  if (!text) return refuse(text.error());
  constexpr const char* kColumns[] = {"x_mm", "y_mm", "z_mm"};
  const auto rows = rows_in_csv(*text, kColumns, "point");
  if (!rows) return refuse(rows.error());
  std::vector<devices::TakenPoint> taken;
  for (std::size_t i = 0; i < rows->size(); ++i)
    taken.push_back({rows->labels[i], {rows->row(i)[0], rows->row(i)[1], rows->row(i)[2]}});
  const auto calibration = devices::calibrate(taken);
  if (!calibration) return refuse(calibration.error());

  const auto station = change_station(file, [&](Station& changed) {
    StationDevice& kept = changed[device];
    kept.calibration = *calibration;
    // Which arm it is stays known through a new calibration.
    kept.ids.arm = arguments.text("--device-id", kept.ids.arm);
    kept.ids.grip = arguments.text("--grip-id", kept.ids.grip);
  });
  if (!station) return refuse(station.error());
  if (arguments.has("--json"))
    std::fputs(json_of_station({{device, station->at(device)}}).c_str(), stdout);
  else
    print(device, *calibration);
  return kDone;
}

constexpr Option kCalibrateOptions[] = {
    {"--device", "left|right", "which of the station's two devices"},
    {"--station", "FILE.json", "where its calibration is stored; the other device's stays"},
    {"--device-id", "ID", "the arm in that place, as `device list` names it"},
    {"--grip-id", "ID", "the stylus on that arm"},
    kJson};

}  // namespace

Command haptics_calibrate_command() {
  return {.name = "haptics calibrate",
          .positionals = "POINTS.csv",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCalibrateOptions,
          .summary =
              "Finds the position of a device on the template (156 mm square, cross of 128 mm, box of 143 mm): "
              "columns point, x_mm, y_mm, z_mm as the device reads them at a, b, c, d, f and, where taken, e. An "
              "error above 1 mm is refused.",
          .run = &run_haptics_calibrate};
}

}  // namespace seldinger::app
