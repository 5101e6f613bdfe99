#include "sim/imaging/ultrasound/cine_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/imaging/float_math.h"

namespace seldinger::imaging {
namespace {

constexpr float kPerDb = 128.0F;
constexpr float kDbPerNeper = 8.6858896F;

}  // namespace

void CineLoop::push(double t_s, std::uint64_t number, const UltrasoundView& view, const PolarPicture& picture,
                    std::optional<ColourPicture> colour) {
  if (kept_.size() < kPictures && next_ == static_cast<int>(kept_.size())) kept_.emplace_back();
  Kept& kept = kept_[static_cast<std::size_t>(next_)];
  next_ = (next_ + 1) % kPictures;
  count_ = std::min(count_ + 1, kPictures);
  kept.t_s = t_s;
  kept.number = number;
  kept.view = view;
  kept.beams = picture.beams;
  kept.samples = picture.samples;
  kept.colour = std::move(colour);
  kept.levels.resize(picture.envelope.size());
  for (std::size_t i = 0; i < picture.envelope.size(); ++i)
    kept.levels[i] = static_cast<std::uint16_t>(
        std::clamp((level_db_of(picture.envelope[i]) - kLeastDb) * kPerDb + 0.5F, 0.0F, 65535.0F));
}

std::optional<CinePicture> CineLoop::back(int pictures) const {
  if (pictures < 0 || pictures >= count_) return std::nullopt;
  const Kept& kept = kept_[static_cast<std::size_t>((next_ - 1 - pictures + kPictures) % kPictures)];
  CinePicture out{kept.t_s, kept.number, kept.view, {kept.beams, kept.samples, {}}, kept.colour};
  out.picture.envelope.resize(kept.levels.size());
  for (std::size_t i = 0; i < kept.levels.size(); ++i)
    out.picture.envelope[i] =
        float_exp((static_cast<float>(kept.levels[i]) / kPerDb + kLeastDb) * (1.0F / kDbPerNeper));
  return out;
}

}  // namespace seldinger::imaging
