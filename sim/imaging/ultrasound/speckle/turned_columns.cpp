#include "sim/imaging/ultrasound/speckle/turned_columns.h"

#include <algorithm>
#include <cstring>
#include <glm/geometric.hpp>

namespace seldinger::imaging {

void TurnedColumns::turn(const tissue::MovedSlab& slab, const glm::vec3 (&axes)[3], const glm::dvec2& low_mm,
                         const glm::dvec2& high_mm, int first_layer, int layers) {
  const auto first = slab.between(low_mm.x, low_mm.y), last = slab.between(high_mm.x, high_mm.y);
  slab_ = &slab;
  left_ = first.i;
  upper_ = first.j;
  across_ = last.i + 2 - first.i;
  down_ = last.j + 2 - first.j;
  layers_ = layers;
  turned_.clear();
  for (int i = 0; i < across_; ++i)
    for (int j = 0; j < down_; ++j)
      for (int l = 0; l < layers; ++l) {
        const glm::vec3 u(slab.column(left_ + i, upper_ + j)[first_layer + l]);
        turned_.push_back({{glm::dot(u, axes[0]), glm::dot(u, axes[1]), glm::dot(u, axes[2]), 0.0F}});
      }
  line_.resize(static_cast<std::size_t>(down_ * layers_));
}

void TurnedColumns::mix(const Node* one, const Node* other, float part, float (*into)[4]) const noexcept {
  for (int l = 0; l < layers_; ++l) {
    float u[4];
    for (int c = 0; c < 4; ++c) u[c] = one[l].xyz[c] + part * (other[l].xyz[c] - one[l].xyz[c]);
    std::memcpy(into[l], u, sizeof u);
  }
}

void TurnedColumns::go_to(double x_mm) noexcept {
  const auto at = slab_->between(x_mm, 0.0);
  const int i = std::clamp(at.i - left_, 0, across_ - 2), columns = down_ * layers_;
  const Node* const here = turned_.data() + i * columns;
  for (int j = 0; j < down_; ++j)
    mix(here + j * layers_, here + columns + j * layers_, at.right,
        &line_[static_cast<std::size_t>(j * layers_)].xyz);
}

void TurnedColumns::lay(double y_mm, float (*mm)[4]) const noexcept {
  const auto at = slab_->between(0.0, y_mm);
  const Node* const here = line_.data() + std::clamp(at.j - upper_, 0, down_ - 2) * layers_;
  mix(here, here + layers_, at.down, mm);
}

}  // namespace seldinger::imaging
