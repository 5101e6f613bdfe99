#include "assessment/questionnaire/shipped_forms.h"

#include <algorithm>
#include <span>

#include "sim/base/check.h"
#include "sim/base/embedded.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> questionnaire_files();
}

namespace seldinger::assessment::questionnaire {

const std::vector<ShippedForm>& shipped_forms() {
  static const std::vector<ShippedForm> kForms = [] {
    std::vector<ShippedForm> forms;
    for (const base::EmbeddedFile& file : embedded::questionnaire_files()) {
      auto form = form_from_json(std::string(file.content));
      CHECK(form.has_value());
      forms.push_back({file.content, std::move(*form)});
    }
    std::sort(forms.begin(), forms.end(),
              [](const ShippedForm& a, const ShippedForm& b) { return a.form.id < b.form.id; });
    return forms;
  }();
  return kForms;
}

const ShippedForm* find_shipped_form(std::string_view form_id) {
  for (const ShippedForm& one : shipped_forms())
    if (one.form.id == form_id) return &one;
  return nullptr;
}

}  // namespace seldinger::assessment::questionnaire
