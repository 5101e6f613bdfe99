// From lines and scatterers to the envelope, a block of beams at a time.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/base/vectors.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/scatterers.h"
#include "sim/imaging/xray/float_math.h"

namespace seldinger::imaging {
namespace {

void check_view(const UltrasoundView& view, std::span<const float> depth_below_skin_mm) {
  CHECK(view.beams >= 1 && view.beams <= 4096 && view.samples >= 1 && view.samples <= 16384);
  CHECK(view.depth_mm > 0.0 && view.depth_mm <= 400.0 && view.frequency_mhz >= 0.0 && view.focus_mm >= 0.0);
  CHECK(view.scatterers_per_cell > 0.0);
  CHECK(base::is_finite(view.origin_lps_mm));
  CHECK(std::abs(glm::length(view.axial) - 1.0) < 1e-6 && std::abs(glm::length(view.lateral) - 1.0) < 1e-6);
  CHECK(std::abs(glm::dot(view.axial, view.lateral)) < 1e-6);
  CHECK(depth_below_skin_mm.empty() || depth_below_skin_mm.size() == static_cast<std::size_t>(view.probe.elements));
}

// The pulse's envelope at whole samples, middle first; ∫h² = 1. Scatterers lie in the sample they fall in, which
// widens by a box of one sample: the kernel is narrower by that (variance dz²/12).
std::vector<float> pulse(const UltrasoundView& view, double sample_mm) {
  const double frequency_mhz = view.frequency_mhz > 0.0 ? view.frequency_mhz : view.probe.frequency_mhz;
  const double sigma = beam_width(view.probe, frequency_mhz, view.focus_mm, 1.0).axial_sigma_mm;
  const double variance = std::max(sigma * sigma - sample_mm * sample_mm / 12.0, 0.01 * sample_mm * sample_mm);
  const int reach = std::max(1, static_cast<int>(std::ceil(3.5 * std::sqrt(variance) / sample_mm)));
  std::vector<double> h;
  double energy = 0.0;
  for (int n = 0; n <= reach; ++n) {
    h.push_back(std::exp(-0.5 * n * n * sample_mm * sample_mm / variance));
    energy += (n == 0 ? 1.0 : 2.0) * h.back() * h.back() * sample_mm;
  }
  std::vector<float> taps;
  for (const double value : h) taps.push_back(static_cast<float>(value / std::sqrt(energy)));
  return taps;
}

// One thread's room for a block of beams.
struct Room {
  std::vector<std::int32_t> sums;
  Line line;
  std::vector<float> re, im, through;  // re and im with the kernel's reach of zeros at both ends
};

class PolarPainter {
 public:
  PolarPainter(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
               std::span<const float> depth_below_skin_mm, PolarPicture& picture)
      : view_(view),
        fan_(fan_of(view)),
        tissue_at_(tissue, inserted),
        walker_(view, tissue_at_, inserted),
        field_(view, tissue_at_),
        below_skin_mm_(depth_below_skin_mm),
        taps_(pulse(view, fan_.sample_mm)),
        wavelength_mm_(
            shaders::us_wavelength_mm(view.frequency_mhz > 0.0 ? view.frequency_mhz : view.probe.frequency_mhz)),
        picture_(picture) {}

  void paint(int first, int end, Room& room) const {
    field_.add_beams(first, end, room.sums);
    for (int beam = first; beam < end; ++beam) {
      walker_.walk(beam, touches(beam), room.line);
      const std::size_t samples = static_cast<std::size_t>(view_.samples);
      paint_line(room.sums.data() + static_cast<std::size_t>(beam - first) * samples * 2, room,
                 picture_.envelope.data() + static_cast<std::size_t>(beam) * samples);
    }
  }

 private:
  bool touches(int beam) const {
    if (below_skin_mm_.empty()) return true;
    const auto element = static_cast<std::size_t>((beam + 0.5) * view_.probe.elements / view_.beams);
    return below_skin_mm_[std::min(element, below_skin_mm_.size() - 1)] >= static_cast<float>(-kContactMm);
  }

  void paint_line(const std::int32_t* sums, Room& room, float* envelope) const {
    const int samples = view_.samples, reach = static_cast<int>(taps_.size()) - 1;
    const auto padded = static_cast<std::size_t>(samples + 2 * reach);
    room.re.assign(padded, 0.0F);
    room.im.assign(padded, 0.0F);
    float* re = room.re.data() + reach;
    float* im = room.im.data() + reach;
    if (room.line.contact) {
      const float* loss_db = room.line.loss_db.data();
      for (int k = 0; k < samples; ++k) {
        // 10^(−dB/20), and what the sums are counted in.
        const float through = float_exp(-0.115129255F * loss_db[k]) * (1.0F / ScattererField::kUnit);
        re[k] = static_cast<float>(sums[2 * k]) * through;
        im[k] = static_cast<float>(sums[2 * k + 1]) * through;
      }
    }
    for (const LineEcho& echo : room.line.echoes) add_echo(echo, re, im);
    for (int k = 0; k < samples; ++k) {
      float sum_re = taps_[0] * re[k], sum_im = taps_[0] * im[k];
      for (int n = 1; n <= reach; ++n) {
        sum_re += taps_[static_cast<std::size_t>(n)] * (re[k - n] + re[k + n]);
        sum_im += taps_[static_cast<std::size_t>(n)] * (im[k - n] + im[k + n]);
      }
      envelope[k] = std::sqrt(sum_re * sum_re + sum_im * sum_im);
    }
  }

  // So that the envelope's peak is the echo's amplitude.
  void add_echo(const LineEcho& echo, float* re, float* im) const {
    const double turns = 2.0 * echo.depth_mm / wavelength_mm_,
                 angle = -6.283185307179586 * (turns - std::floor(turns));
    const double at = echo.depth_mm / fan_.sample_mm;
    const double share = echo.between_samples ? taps_[0] + taps_[1] : taps_[0];
    const auto add = [&](int k) {
      if (k < 0 || k >= view_.samples) return;
      re[k] += static_cast<float>(echo.amplitude / share * std::cos(angle));
      im[k] += static_cast<float>(echo.amplitude / share * std::sin(angle));
    };
    if (!echo.between_samples) return add(static_cast<int>(std::floor(at)));
    const int after = static_cast<int>(std::lround(at));
    add(after - 1);
    add(after);
  }

  const UltrasoundView& view_;
  Fan fan_;
  TissueAt tissue_at_;
  LineWalker walker_;
  ScattererField field_;
  std::span<const float> below_skin_mm_;
  std::vector<float> taps_;
  double wavelength_mm_;
  PolarPicture& picture_;
};

}  // namespace

void ultrasound_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                      std::span<const float> depth_below_skin_mm, PolarPicture& picture) {
  check_view(view, depth_below_skin_mm);
  picture.beams = view.beams;
  picture.samples = view.samples;
  picture.envelope.resize(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples));
  const PolarPainter painter(tissue, view, inserted, depth_below_skin_mm, picture);
  // The same blocks for any number of threads. Wide enough that scatterers at their sides, which two blocks see,
  // are few; the arctangent's series wants them narrow.
  const int block = std::clamp(view.beams / 16, 1, 32), blocks = (view.beams + block - 1) / block;
  std::atomic<int> next{0};
  const auto work = [&] {
    Room room;
    for (int i = next.fetch_add(1); i < blocks; i = next.fetch_add(1))
      painter.paint(i * block, std::min(view.beams, (i + 1) * block), room);
  };
  const int wanted = view.threads > 0 ? view.threads : static_cast<int>(std::thread::hardware_concurrency());
  std::vector<std::jthread> others;
  for (int i = 1; i < std::min(wanted, blocks); ++i) others.emplace_back(work);
  work();
}

std::vector<float> polar_db(const PolarPicture& picture) {
  std::vector<float> db(picture.envelope.size());
  const auto beams = static_cast<std::size_t>(picture.beams), samples = static_cast<std::size_t>(picture.samples);
  for (std::size_t b = 0; b < beams; ++b)
    for (std::size_t k = 0; k < samples; ++k)
      db[k * beams + b] = 8.6858896F * float_log(std::max(picture.envelope[b * samples + k], 1e-10F));
  return db;
}

}  // namespace seldinger::imaging
