// The graded cases that are made of a CT of a patient where one is given (source_of).
#include "app/demo/demo_case_parts.h"

namespace seldinger::app {
namespace {

using cases::StructureRule;
using volume::TissueClass;

DemoCase contrast_liver() {
  DemoCase made = liver_between_ribs();
  made.source = DemoSource::contrast_liver;
  made.lesions = {solid_form(cases::LesionKind::hcc, {-115.0, -5.0, -98.0}, 7.5, 80.0)};
  made.structures = {
      of_class("lung", StructureRule::critical, TissueClass::lung),
      // Potential spaces and a bundle that this CT does not show: along the ribs that it does.
      drawn("pleural_recess", StructureRule::critical, TissueClass::soft_tissue,
            cases::Tube{{{-131, -36, -68}, {-140, -16, -68}, {-144, 8, -70}, {-144, 32, -74}}, 5.0}),
      drawn("intercostal_bundle", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-143, -10, -82}, {-139.5, -20, -92}, {-137, -25, -97}, {-134.5, -34.5, -107}}, 2.0},
            130.0),
      drawn("liver", StructureRule::organ, TissueClass::soft_tissue,
            cases::Ellipsoid{{-80.0, -10.0, -90.0}, {60.0, 72.0, 60.0}})};
  return made;
}

DemoCase ct_kidney_cortex() {
  DemoCase made = kidney_cortex();
  made.source = DemoSource::abdomen_pelvis;
  made.lesions = {place_form({66.0, 79.0, -624.0}, {12.0, 7.0, 9.0})};
  made.structures = {drawn("kidney", StructureRule::organ, TissueClass::kidney,
                           cases::Ellipsoid{{61.5, 72.0, -604.0}, {27.0, 17.5, 42.0}}),
                     drawn("renal_sinus", StructureRule::critical, TissueClass::fat,
                           cases::Ellipsoid{{57.0, 65.0, -604.0}, {9.0, 6.0, 15.0}}),
                     of_class("colon_gas", StructureRule::critical, TissueClass::gas),
                     of_class("lung", StructureRule::critical, TissueClass::lung)};
  return made;
}

DemoCase ct_jugular_vein() {
  DemoCase made = jugular_vein();
  made.source = DemoSource::thorax_inlet;
  // The lumen where it is entered, above the end of the clavicle.
  made.lesions = {sphere_form({-20.9, -217.0, 86.0}, 6.0, 12.0)};
  made.structures = {
      drawn("carotid", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-9.5, -216, 91}, {-9.7, -212.4, 88}, {-10.5, -187.5, 78}, {-12, -178, 66}}, 3.5}, 45.0),
      drawn("jugular_vein", StructureRule::target, TissueClass::vessel,
            cases::Tube{{{-19.5, -228, 91}, {-20.2, -221.4, 88}, {-24, -199, 78}, {-26, -190, 66}}, 6.0}, 43.0),
      of_class("lung", StructureRule::critical, TissueClass::lung)};
  return made;
}

DemoCase ct_beside_a_vein() {
  DemoCase made = beside_a_vein();
  made.source = DemoSource::contrast_liver;
  made.lesions = {solid_form(cases::LesionKind::metastasis, {-79.0, -34.0, -84.0}, 5.0, 70.0)};
  made.structures = {
      drawn("hepatic_vein", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-74, -46, -84}, {-70, -36, -80}, {-60, -8, -74}, {-46, 22, -66}}, 3.0}, 150.0),
      drawn("liver", StructureRule::organ, TissueClass::soft_tissue,
            cases::Ellipsoid{{-80.0, -10.0, -90.0}, {60.0, 72.0, 60.0}}),
      of_class("lung", StructureRule::critical, TissueClass::lung)};
  return made;
}

}  // namespace

const std::vector<DemoCase>& demo_cases_of_ct() {
  static const std::vector<DemoCase> all = {contrast_liver(), ct_kidney_cortex(), ct_jugular_vein(),
                                            ct_beside_a_vein(), to_be_deferred(contrast_liver())};
  return all;
}

}  // namespace seldinger::app
