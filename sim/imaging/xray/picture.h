// One fluoroscopy frame: from path lengths to what a person sees. Order: transmission of the spectrum, quantum
// noise, spread of light in the screen, logarithm, window. Bright is what lets radiation through: bones and needles
// are dark, as in live fluoroscopy. Behind the collimator's leaves it is black. What the patient scatters lies
// under it evenly, where the pulse has some. Last, where they are asked for, veiling glare and lag (panel.h). Not
// modelled: focal spot; read-out noise is added before the spread of light, after which it belongs, and is small.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "sim/imaging/xray/exposure.h"
#include "sim/imaging/xray/panel.h"

namespace seldinger::imaging {

// Of log(signal/signal of the open beam), so that it does not depend on tube current or distance.
struct LogWindow {
  double center = -3.0, width = 4.0;
};

struct PictureSettings {
  std::uint64_t seed = 1, frame = 1;  // of the noise
  double t_s = 0.0;                   // when the pulse was: a panel that lags has lost so much of what it saw
  std::optional<LogWindow> window;    // else from the open field's content
  bool noise = true;
  PanelFlaws flaws;
  int threads = 1;  // the picture has the same bits for any number
};

struct FluoroscopyPicture {
  int width_px = 0, height_px = 0;
  std::vector<unsigned char> grey;  // row-major; NaN becomes 255 so that it is seen
  std::vector<float> log_signal;    // log(signal/open); 0 outside the open field
  OpenField open;
  LogWindow window;
  std::vector<float> blurred;  // between two passes; kept so that the next frame allocates nothing
  // Of a panel that lags: what kLag's parts hold after this frame, in quanta, the field that its pixels span, and
  // when it was.
  std::array<std::vector<float>, kLag.size()> lagging;
  double lagging_field_mm = 0.0, lagging_t_s = 0.0;
};

// `lengths` span the pulse's whole field (field_side_mm of its magnification) at the panel. `picture`'s buffers are
// used again.
void render_picture(const BeamSignal& beam, const Detector& detector, double field_side_mm, const Pulse& pulse,
                    const PathLengths& lengths, const PictureSettings& settings, FluoroscopyPicture& picture);

// Weights of one side of a separable kernel (middle first, Σ over both sides = 1) whose MTF is a Gaussian's,
// exp(−2π²σ²f²): for σ ≤ 1 pixel by least squares with seven weights, within 0.02 to 80 % of the Nyquist frequency
// and 0.045 at it; beyond, sampled.
std::vector<float> blur_weights(double sigma_px);

// The window from 1 % to 99 % of the content of the open field, but no further than 2 below and 1.5 above its
// median; what is nearly open beam does not count unless it is most of the field.
LogWindow window_of(const std::vector<float>& log_signal, int width_px, const OpenField& open);

// Linear from 0 at the window's lower end to 255 at its upper.
void grey_from_log_signal(const float* log_signal, int count, const LogWindow& window,
                          unsigned char* grey) noexcept;

}  // namespace seldinger::imaging
