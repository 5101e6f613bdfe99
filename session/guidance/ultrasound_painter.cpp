#include "session/guidance/ultrasound_painter.h"

#include <algorithm>
#include <cmath>

#include "sim/base/failure.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::session {
namespace {

// As the picture of the case is set.
imaging::ConsolePreset preset_of(const cases::Picture& picture) {
  const imaging::Probe* probe = imaging::probe_named(picture.probe);
  return {"case", probe != nullptr ? *probe : imaging::kC52v, picture.depth_mm, 0.0, 60.0};
}

}  // namespace

UltrasoundPainter::UltrasoundPainter(const cases::Case& scene, std::uint64_t seed, PicturesBy by)
    : scene_(scene), seed_(seed), sight_(scene), console_(preset_of(scene.picture)) {
  if (by == PicturesBy::gpu) try_gpu();
}

void UltrasoundPainter::try_gpu() {
  try {
    context_.emplace();
    sight_.draw_on(*context_);
  } catch (const base::Failure&) {  // no GL without a window, or too little memory: the CPU's are the same
    leave_gpu();
  }
}

void UltrasoundPainter::leave_gpu() {
  sight_.draw_on_cpu();
  context_.reset();
}

std::string UltrasoundPainter::method() const {
  const std::string on = !context_ ? "CPU" : context_->software() ? "GL in software" : "GPU";
  return (method_ == imaging::UltrasoundMethod::lattice ? "lattice, " : "scatterers, ") + on;
}

void UltrasoundPainter::set_speckle(imaging::UltrasoundMethod method) {
  method_ = method;
  sight_.set_method(method);
}

void UltrasoundPainter::draw(const engine::Moment& moment, ShownPicture& shown) {
  if (console_.frozen() == shown.live) console_.set_frozen(!shown.live);
  if (console_.frozen() && shown.number > 0) return;  // it stands, until the console is changed
  if (!console_.frozen()) receive(moment);
  develop(shown);
}

void UltrasoundPainter::receive(const engine::Moment& moment) {
  const cases::State& state = moment.state;
  const imaging::NeedlePose needle =
      imaging::needle_pose(scene_.instrument, state.needle.tip_lps_mm, state.needle.direction);
  const auto make = [&] {
    return sight_.polar(probe_in(state), state.probe.console, needle, seed_, pictures_, polar_, moment.displacement,
                        state.t_s, LooksOf::last_frames);
  };
  ++pictures_;
  imaging::UltrasoundView view;
  try {
    view = make();
  } catch (const base::Failure&) {
    if (!context_) throw;
    leave_gpu();
    view = make();
  }
  console_.show(state.t_s, pictures_, view, polar_,
                console_.frozen()
                    ? std::nullopt  // it keeps what it has
                    : sight_.colour(probe_in(state), state.probe.console, needle, state.t_s, moment.displacement));
}

void UltrasoundPainter::develop(ShownPicture& shown) {
  const auto cine = console_.shown();
  if (!cine) return;
  if (!converter_ || converted_depth_mm_ != cine->view.depth_mm) {
    converter_.emplace(cine->view, imaging::DisplaySize{});
    colour_screen_.reset();
    converted_depth_mm_ = cine->view.depth_mm;
  }
  converter_->grey(cine->view, console_.knobs(), cine->picture, shown.picture.grey);
  shown.picture.width_px = converter_->width_px();
  shown.picture.height_px =
      std::min(converter_->height_px(),  // without the empty rows below a wide field
               static_cast<int>(std::ceil((cine->view.depth_mm - converter_->top_mm()) / converter_->pixel_mm())));
  shown.picture.grey.resize(static_cast<std::size_t>(shown.picture.height_px) *
                            static_cast<std::size_t>(shown.picture.width_px));
  shown.picture.colour.clear();
  if (cine->colour) {
    imaging::colour_numbers(colour_screen_, *converter_, console_.knobs(), *cine->colour, shown.picture.colour);
    shown.picture.colour.resize(shown.picture.grey.size());
  }
  shown.pixel_mm = converter_->pixel_mm();
  shown.top_mm = converter_->top_mm();
  shown.console = {cine->view.depth_mm, cine->view.focus_mm, imaging::working_mhz(cine->view)};
  shown.console.compound_deg = cine->view.compound_deg;
  if (cine->colour) shown.console.colour_mm_s = cine->colour->scale_mm_s;
  shown.t_s = cine->t_s;
  shown.cine_back = console_.scrolled();
  ++shown.number;
}

}  // namespace seldinger::session
