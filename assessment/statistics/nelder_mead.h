// The minimum of a function of few variables without its derivatives: the simplex of Nelder and Mead (Computer
// Journal 7, 1965), begun anew until that changes nothing.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace seldinger::assessment::statistics {

struct Lowest {
  std::vector<double> at;
  double value = 0.0;
};

template <typename Function>
class Simplex {
 public:
  Simplex(const Function& of, const std::vector<double>& start, double step) : of_(of) {
    corners_.push_back({start, of(start)});
    for (std::size_t i = 0; i < start.size(); ++i) {
      std::vector<double> at = start;
      at[i] += step;
      corners_.push_back({at, of(at)});
    }
    sort();
  }

  const Lowest& lowest() const { return corners_.front(); }
  bool settled(double within) const { return corners_.back().value - corners_.front().value <= within; }

  void advance() {
    const std::size_t n = corners_.size() - 1;
    std::vector<double> centre(n);
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 0; k < n; ++k) centre[i] += corners_[k].at[i] / static_cast<double>(n);
    Lowest& worst = corners_.back();
    const Lowest reflected = along(centre, worst.at, -1.0);
    if (reflected.value < corners_.front().value) {
      const Lowest further = along(centre, worst.at, -2.0);
      worst = further.value < reflected.value ? further : reflected;
    } else if (reflected.value < corners_[n - 1].value) {
      worst = reflected;
    } else {
      const Lowest nearer = along(centre, worst.at, reflected.value < worst.value ? -0.5 : 0.5);
      if (nearer.value < std::min(worst.value, reflected.value)) {
        worst = nearer;
      } else {
        for (std::size_t k = 1; k <= n; ++k) corners_[k] = along(corners_.front().at, corners_[k].at, 0.5);
      }
    }
    sort();
  }

 private:
  Lowest along(const std::vector<double>& centre, const std::vector<double>& corner, double by) const {
    std::vector<double> at(centre.size());
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = centre[i] + by * (corner[i] - centre[i]);
    const double value = of_(at);
    return {std::move(at), value};
  }
  void sort() {
    std::stable_sort(corners_.begin(), corners_.end(),
                     [](const Lowest& a, const Lowest& b) { return a.value < b.value; });
  }

  const Function& of_;
  std::vector<Lowest> corners_;
};

// `of` takes a vector and answers no NaN; where the function is not defined it may be infinite.
template <typename Function>
Lowest nelder_mead(const Function& of, const std::vector<double>& start, double step, double within) {
  constexpr int kMostSteps = 2000, kMostStarts = 6;
  Lowest lowest{start, of(start)};
  for (int i = 0; i < kMostStarts; ++i, step *= 0.2) {
    Simplex<Function> simplex(of, lowest.at, step);
    for (int k = 0; k < kMostSteps && !simplex.settled(within); ++k) simplex.advance();
    const double gain = lowest.value - simplex.lowest().value;
    lowest = simplex.lowest();
    if (i > 0 && gain <= within) break;
  }
  return lowest;
}

}  // namespace seldinger::assessment::statistics
