#include "sim/haptics/contact/soft_contact.h"

#include <algorithm>
#include <iterator>

namespace seldinger::haptics {
namespace {

// Of (√(R δ) / h)^k.
constexpr double kLayer[] = {1.0, 1.133, 1.283, 0.769, 0.0975};

// Force and its slope without any limit, by the root of the depth. F = 16/3 G √R δ^1.5 Σ c_k (√(R δ) / h)^k.
struct Elastic {
  double factor, per_root;  // 16/3 G √R; √R / h

  double force_n(double root) const {
    double sum = 0.0, power = 1.0;
    for (const double coefficient : kLayer) {
      sum += coefficient * power;
      power *= per_root * root;
    }
    return factor * root * root * root * sum;
  }
  double stiffness_n_mm(double root) const {
    double sum = 0.0, power = 1.0;
    for (std::size_t k = 0; k < std::size(kLayer); ++k) {
      sum += 0.5 * static_cast<double>(3 + k) * kLayer[k] * power;
      power *= per_root * root;
    }
    return factor * root * sum;
  }
  // Where the stiffness, which rises steadily, reaches `most`; at most `root`.
  double root_of_stiffness(double most, double root) const {
    if (stiffness_n_mm(root) <= most) return root;
    double low = 0.0, high = root;
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (stiffness_n_mm(middle) <= most ? low : high) = middle;
    }
    return low;
  }
};

Elastic elastic_of(const SoftContact& contact, double per_bone_mm) {
  const double root_radius = std::sqrt(contact.radius_mm);
  return {16.0 / 3.0 * contact.shear_n_mm2 * root_radius, root_radius * per_bone_mm};
}

}  // namespace

double SoftContact::force_n(double depth_mm, double per_bone_mm) const noexcept {
  if (!(depth_mm > 0.0)) return 0.0;
  const Elastic elastic = elastic_of(*this, per_bone_mm);
  const double root = elastic.root_of_stiffness(most_stiffness_n_mm, std::sqrt(depth_mm));
  return elastic.force_n(root) + most_stiffness_n_mm * std::max(0.0, depth_mm - root * root);
}

double SoftContact::stiffness_n_mm(double depth_mm, double per_bone_mm) const noexcept {
  if (!(depth_mm > 0.0)) return 0.0;
  return std::min(most_stiffness_n_mm, elastic_of(*this, per_bone_mm).stiffness_n_mm(std::sqrt(depth_mm)));
}

double SoftContact::side_stiffness_n_mm(double depth_mm) const noexcept {
  if (!(depth_mm > 0.0)) return 0.0;
  return std::min(most_stiffness_n_mm, 16.0 / 3.0 * shear_n_mm2 * std::sqrt(radius_mm * depth_mm));
}

}  // namespace seldinger::haptics
