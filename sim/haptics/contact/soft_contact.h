// A rigid sphere pressed into skin over bone: Hertz's contact with an incompressible half space (1881), corrected
// for a layer of finite depth bonded to something rigid (Dimitriadis, Biophys. J. 82, 2002, ν = 0.5; coefficients
// recalled, the first three are tested against its general formula). Bone is felt through soft tissue without any
// switch: the force rises steadily with depth and with how near the bone is.
#pragma once

#include <cmath>

namespace seldinger::haptics {

struct SoftContact {
  double radius_mm = 20.0;      // of the sphere (our judgement: 1.8 N at 8 mm)
  double shear_n_mm2 = 0.0033;  // modulus G of the tissue: 3.3 kPa (our judgement)
  double most_stiffness_n_mm =
      0.48;  // beyond the depth where it gets stiffer, the force goes on in a straight line

  // All by depth in mm (≤ 0: no contact) and 1 / mm of the bone's depth below the skin (0: none).
  double force_n(double depth_mm, double per_bone_mm) const noexcept;
  double stiffness_n_mm(double depth_mm, double per_bone_mm) const noexcept;  // of force_n
  // Against a shift sideways without slip (Mindlin, J. Appl. Mech. 16, 1949: 8 G a / (2 − ν)).
  double side_stiffness_n_mm(double depth_mm) const noexcept;
};

}  // namespace seldinger::haptics
