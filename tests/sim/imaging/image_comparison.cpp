#include "tests/sim/imaging/image_comparison.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "tests/fixtures/places.h"

namespace seldinger::imaging {
namespace {

void write_pgm(const std::filesystem::path& path, const HuImage& hu, int width_px, double center_hu,
               double window_hu) {
  const std::vector<unsigned char> grey = grey_from_hu(hu, center_hu, window_hu);
  std::ofstream file(path, std::ios::binary);
  file << "P5\n" << width_px << ' ' << hu.size() / static_cast<std::size_t>(width_px) << "\n255\n";
  for (const unsigned char value : grey) file.put(static_cast<char>(value));
}

}  // namespace

testing::AssertionResult images_agree(const HuImage& result, const HuImage& reference, int width_px,
                                      double tolerance_hu, const PixelMask& left_out, const std::string& name) {
  if (result.size() != reference.size() || (!left_out.empty() && left_out.size() != result.size()))
    return testing::AssertionFailure() << name << ": sizes differ";
  HuImage difference(result.size(), 0.0F);
  std::size_t beyond = 0, worst = 0;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (!left_out.empty() && left_out[i]) continue;
    difference[i] = std::abs(result[i] - reference[i]);
    if (difference[i] <= tolerance_hu) continue;  // NaN is not
    // A difference that is NaN is worse than any number.
    if (beyond++ == 0 || (!std::isnan(difference[worst]) && !(difference[i] <= difference[worst]))) worst = i;
  }
  if (beyond == 0) return testing::AssertionSuccess();

  const std::filesystem::path folder = fixtures::test_out_dir() / "imaging" / name;
  std::filesystem::create_directories(folder);
  write_pgm(folder / "result.pgm", result, width_px, 1024.0, 4096.0);
  write_pgm(folder / "reference.pgm", reference, width_px, 1024.0, 4096.0);
  write_pgm(folder / "difference.pgm", difference, width_px, 4.0 * tolerance_hu, 8.0 * tolerance_hu);
  const auto width = static_cast<std::size_t>(width_px);
  return testing::AssertionFailure() << name << ": " << beyond << " of " << result.size()
                                     << " pixels differ by more than " << tolerance_hu << " HU; worst ("
                                     << worst % width << ", " << worst / width << "): " << result[worst]
                                     << " instead of " << reference[worst] << "; pictures in " << folder.string();
}

double share_of(const PixelMask& mask) {
  return static_cast<double>(std::count(mask.begin(), mask.end(), true)) / static_cast<double>(mask.size());
}

}  // namespace seldinger::imaging
