// What the tool in hand can set, as numbers and lists.
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/window/screens/editing/panel_editor.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "assessment/grading/usual_limit.h"
#include "assessment/registry.h"
#include "casedb/cases/setting_table.h"
#include "reports/words/metric_words.h"
#include "sim/case/gauge.h"

namespace seldinger::app {
namespace {

constexpr float kFieldPx = 170.0F;

// A list that falls open, by its label where it is closed.
bool begin_choice(const char* label, const std::string& now) {
  const bool open = ImGui::BeginCombo(label, now.c_str());
  if (!open) note_item(label);
  return open;
}

// The box beside it says whether there is one.
bool optional_number(const char* label, std::optional<double>& value, double usual, const char* format,
                     bool& in_hand) {
  ImGui::PushID(label);
  bool told = value.has_value();
  bool changed = ImGui::Checkbox("##told", &told);
  if (changed) value = told ? std::optional(usual) : std::nullopt;
  ImGui::SameLine();
  double shown = value.value_or(usual);
  ImGui::BeginDisabled(!told);
  ImGui::SetNextItemWidth(scaled(kFieldPx - 36.0F));
  ImGui::InputDouble(label, &shown, 0.0, 0.0, format);
  note_item(label);
  in_hand = in_hand || ImGui::IsItemActive();
  if (told && value) value = shown;
  changed = changed || ImGui::IsItemDeactivatedAfterEdit();
  ImGui::EndDisabled();
  ImGui::PopID();
  return changed;
}

template <std::size_t n, typename Value, typename Name>
bool choice(const char* label, Value& value, const std::array<Value, n>& all, const Name& name) {
  bool changed = false;
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  if (!begin_choice(label, std::string(name(value)))) return false;
  for (const Value one : all)
    if (ImGui::Selectable(std::string(name(one)).c_str(), one == value)) {
      value = one;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

constexpr std::array<cases::LesionOutline, 3> kLesionOutlines = {
    cases::LesionOutline::sphere, cases::LesionOutline::ellipsoid, cases::LesionOutline::irregular};
constexpr std::array<cases::StructureRule, 6> kRules = {
    cases::StructureRule::critical,   cases::StructureRule::major, cases::StructureRule::advisory,
    cases::StructureRule::must_cross, cases::StructureRule::organ, cases::StructureRule::target};

bool draw_gauge(const char* label, cases::Instrument& needle) {
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  int gauge = 0;
  for (const cases::Gauge& one : cases::kGauges)
    if (std::abs(one.outer_mm - 2.0 * needle.radius_mm) < 0.05) gauge = one.number;
  if (!begin_choice(label, gauge > 0 ? std::to_string(gauge) : "another")) return false;
  bool changed = false;
  for (const cases::Gauge& one : cases::kGauges)
    if (ImGui::Selectable(std::to_string(one.number).c_str(), one.number == gauge)) {
      needle.radius_mm = one.outer_mm / 2.0;
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

// Beside the main one: a box each.
bool draw_further(const char* label, casedb::CaseSetting& setting) {
  bool changed = false;
  ImGui::TextUnformatted(label);
  for (const auto& one : casedb::kModalityWords) {
    if (one.value == setting.modality) continue;
    auto& further = setting.further_modalities;
    bool also = std::find(further.begin(), further.end(), one.value) != further.end();
    ImGui::SameLine();
    if (!ImGui::Checkbox((std::string(one.name) + "##also").c_str(), &also)) continue;
    if (also)
      further.push_back(one.value);
    else
      std::erase(further, one.value);
    changed = true;
  }
  return changed;
}

// What a structure is to whoever punctures.
constexpr auto kRuleWords =
    base::names<cases::StructureRule>({{cases::StructureRule::critical, "never to be touched (critical)"},
                                       {cases::StructureRule::major, "a complication (major)"},
                                       {cases::StructureRule::advisory, "better avoided (advisory)"},
                                       {cases::StructureRule::must_cross, "to be crossed"},
                                       {cases::StructureRule::organ, "the organ around the target"},
                                       {cases::StructureRule::target, "the lumen to be reached"}});

enum class Form { sphere, ellipsoid, tube, tissue };
constexpr std::array<Form, 4> kForms = {Form::sphere, Form::ellipsoid, Form::tube, Form::tissue};
const char* name_of(Form form) {
  constexpr std::array<const char*, 4> kNames = {"sphere", "ellipsoid", "tube", "all of a tissue"};
  return kNames[static_cast<std::size_t>(form)];
}
Form form_of(const casedb::StructureRow& row) {
  if (row.kind == casedb::StructureKind::tissue_class) return Form::tissue;
  return static_cast<Form>(std::min<std::size_t>(row.drawn.index(), 2));
}
void set_form(Form form, casedb::StructureRow& row) {
  row.kind = form == Form::tissue ? casedb::StructureKind::tissue_class : casedb::StructureKind::drawn;
  if (form == Form::sphere) row.drawn = cases::Sphere{{}, 6.0};
  if (form == Form::ellipsoid) row.drawn = cases::Ellipsoid{{}, glm::dvec3(10.0, 8.0, 8.0)};
  if (form == Form::tube) row.drawn = cases::Tube{{}, 3.0};
}

// Fills a text field when what it shows has changed elsewhere.
template <std::size_t n>
void fill(std::array<char, n>& field, std::string& of, const std::string& value) {
  if (of == value) return;
  of = value;
  field.fill('\0');
  value.copy(field.data(), n - 1);
}

std::string metric_words(const std::string& id) {
  return reports::metric_label(id);
}

}  // namespace

bool number_field(const char* label, double& value, double step, const char* format, bool& in_hand) {
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  ImGui::InputDouble(label, &value, step, 10.0 * step, format);
  note_item(label);
  in_hand = in_hand || ImGui::IsItemActive();
  return ImGui::IsItemDeactivatedAfterEdit();
}

bool EditorPanel::draw_lesion_kind() {
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  if (!begin_choice("kind", cases::about(form_.kind).words)) return false;
  bool changed = false;
  for (const cases::LesionKindRow& row : cases::lesion_kinds())
    if (ImGui::Selectable(row.words, row.kind == form_.kind)) {
      form_.kind = row.kind;
      if (row.kind != cases::LesionKind::by_hu) {
        form_.hu = row.ct.hu;
        form_.adds = row.ct.adds;
      }
      changed = true;
    }
  ImGui::EndCombo();
  return changed;
}

void EditorPanel::draw_lesion(CaseEditor& editor) {
  heading(editor.lesion < editor.lesions().size() ? "Lesion" : "A new lesion: click its middle in a plane");
  for (std::size_t i = 0; i < editor.lesions().size(); ++i) {
    const std::string label = (i == 0 ? "1, the target" : std::to_string(i + 1));
    if (ImGui::RadioButton(label.c_str(), editor.lesion == i)) {
      editor.lesion = i;
      form_in_hand_ = false;
      if (editor.scene()) editor.view.go_to(editor.scene()->scene.volume, editor.lesions()[i].form.center_lps_mm);
    }
    ImGui::SameLine();
  }
  if (ImGui::RadioButton("new", editor.lesion >= editor.lesions().size())) editor.lesion = editor.lesions().size();
  const bool there = editor.lesion < editor.lesions().size();
  if (!form_in_hand_) form_ = there ? editor.shown_lesions()[editor.lesion] : editor.new_lesion;
  form_in_hand_ = false;
  bool changed = draw_lesion_kind();
  const bool other_form = choice("form", form_.outline, kLesionOutlines, [](cases::LesionOutline kind) {
    return base::name_of(cases::kLesionOutlineNames, kind);
  });
  if (other_form) form_.roughness = form_.outline == cases::LesionOutline::irregular ? 0.12 : 0.0;
  changed = other_form || changed;
  if (form_.outline == cases::LesionOutline::ellipsoid) {
    changed = number_field("radius x mm", form_.radii_mm.x, 0.5, "%.1f", form_in_hand_) || changed;
    changed = number_field("radius y mm", form_.radii_mm.y, 0.5, "%.1f", form_in_hand_) || changed;
    changed = number_field("radius z mm", form_.radii_mm.z, 0.5, "%.1f", form_in_hand_) || changed;
  } else {
    changed = number_field("radius mm", form_.radii_mm.x, 0.5, "%.1f", form_in_hand_) || changed;
    form_.radii_mm = glm::dvec3(form_.radii_mm.x);
  }
  if (form_.outline == cases::LesionOutline::irregular)
    changed = number_field("roughness", form_.roughness, 0.02, "%.2f", form_in_hand_) || changed;
  changed = number_field(form_.adds ? "HU added" : "HU", form_.hu, 5.0, "%.0f", form_in_hand_) || changed;
  ImGui::SameLine();
  changed = ImGui::Checkbox("to the tissue", &form_.adds) || changed;
  changed = number_field("soft edge mm", form_.edge_mm, 0.5, "%.1f", form_in_hand_) || changed;
  if (!there) {
    editor.new_lesion = form_;
    return;
  }
  if (changed) {
    editor.put_lesion(editor.lesion, form_);
    form_in_hand_ = false;
  }
  const glm::dvec3& p = form_.center_lps_mm;
  ImGui::Text("at %.1f, %.1f, %.1f mm", p.x, p.y, p.z);
  ImGui::SameLine();
  if (ImGui::Button("Remove (Del)")) editor.remove_lesion(editor.lesion);
}

void EditorPanel::choose_structure(CaseEditor& editor) {
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  const bool there = editor.structure < editor.structures().size();
  if (ImGui::BeginCombo("structure", there ? editor.structures()[editor.structure].name.c_str() : "a new one")) {
    for (std::size_t i = 0; i < editor.structures().size(); ++i)
      if (ImGui::Selectable((editor.structures()[i].name + "##" + std::to_string(i)).c_str(),
                            i == editor.structure)) {
        editor.structure = i;
        structure_in_hand_ = false;
        const casedb::StructureRow& one = editor.structures()[i];
        const cases::Bounds bounds = cases::bounds_of(one.drawn);
        if (one.kind == casedb::StructureKind::drawn && editor.scene())
          editor.view.go_to(editor.scene()->scene.volume, 0.5 * (bounds.low_lps_mm + bounds.high_lps_mm));
      }
    if (ImGui::Selectable("a new one", !there)) {
      editor.structure = editor.structures().size();
      structure_in_hand_ = false;
    }
    ImGui::EndCombo();
  }
}

void EditorPanel::draw_structure(CaseEditor& editor) {
  choose_structure(editor);
  if (!structure_in_hand_)
    structure_ = editor.structure < editor.structures().size() ? editor.shown_structures()[editor.structure]
                                                               : editor.new_structure;
  structure_in_hand_ = false;
  const bool stored = editor.structure < editor.structures().size();
  bool changed = draw_structure_meaning();
  // The form: chosen for a new structure, fixed for a stored one.
  Form form = form_of(structure_);
  if (stored && structure_.kind == casedb::StructureKind::label) {
    ImGui::TextDisabled("label %d of a map", structure_.label);
  } else if (stored) {
    ImGui::TextDisabled("%s", name_of(form));
  } else if (choice("form", form, kForms, [](Form one) { return std::string(name_of(one)); })) {
    editor.drop_drawing();
    set_form(form, structure_);
  }
  if (structure_.kind == casedb::StructureKind::drawn) changed = draw_drawn_structure() || changed;
  // A stored structure is changed at once.
  if (stored) {
    if (changed) {
      editor.put_structure(editor.structure, structure_);
      structure_in_hand_ = false;
    }
    if (ImGui::Button("Remove (Del)")) editor.remove_structure(editor.structure);
    return;
  }
  // A new one waits until it is added here or drawn in the planes.
  editor.new_structure = structure_;
  if (structure_.kind != casedb::StructureKind::drawn) {
    if (ImGui::Button("Add")) editor.add_structure(structure_);
    quiet("All voxels of the CT that are of this tissue.");
  } else if (editor.drawing()) {
    if (ImGui::Button("Finish the tube (Enter)")) editor.finish_drawing();
    ImGui::SameLine();
    if (ImGui::Button("Drop it (Esc)")) editor.drop_drawing();
  } else {
    quiet(form == Form::tube ? "Click its points one after another, in any plane; Enter finishes it."
                             : "Click its middle in a plane.");
  }
}

bool EditorPanel::draw_structure_meaning() {
  fill(name_, name_of_, structure_.name);
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  ImGui::InputText("name", name_.data(), name_.size());
  bool changed = ImGui::IsItemDeactivatedAfterEdit();
  if (changed) structure_.name = name_of_ = name_.data();
  changed = choice("rule", structure_.rule, kRules,
                   [](cases::StructureRule rule) { return base::name_of(kRuleWords, rule); }) ||
            changed;
  ImGui::SetNextItemWidth(scaled(kFieldPx));
  if (ImGui::BeginCombo("tissue", volume::about(structure_.tissue).name)) {
    for (std::size_t i = 0; i < volume::kTissueClasses; ++i) {
      const auto tissue = static_cast<volume::TissueClass>(i);
      if (!ImGui::Selectable(volume::about(tissue).name, tissue == structure_.tissue)) continue;
      structure_.tissue = tissue;
      if (structure_.hu) structure_.hu = volume::typical_hu(tissue);
      changed = true;
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool EditorPanel::draw_drawn_structure() {
  bool changed = false;
  if (auto* sphere = std::get_if<cases::Sphere>(&structure_.drawn))
    changed = number_field("radius mm", sphere->radius_mm, 0.5, "%.1f", structure_in_hand_) || changed;
  if (auto* tube = std::get_if<cases::Tube>(&structure_.drawn))
    changed = number_field("radius mm", tube->radius_mm, 0.5, "%.1f", structure_in_hand_) || changed;
  if (auto* ellipsoid = std::get_if<cases::Ellipsoid>(&structure_.drawn)) {
    changed = number_field("radius x mm", ellipsoid->radii_mm.x, 0.5, "%.1f", structure_in_hand_) || changed;
    changed = number_field("radius y mm", ellipsoid->radii_mm.y, 0.5, "%.1f", structure_in_hand_) || changed;
    changed = number_field("radius z mm", ellipsoid->radii_mm.z, 0.5, "%.1f", structure_in_hand_) || changed;
  }
  bool painted = structure_.hu.has_value();
  if (ImGui::Checkbox("shown, with HU", &painted)) {
    structure_.hu = painted ? std::optional(volume::typical_hu(structure_.tissue)) : std::nullopt;
    changed = true;
  }
  if (structure_.hu) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(scaled(90.0F));
    ImGui::InputDouble("##hu", &*structure_.hu, 0.0, 0.0, "%.0f");
    structure_in_hand_ = structure_in_hand_ || ImGui::IsItemActive();
    changed = changed || ImGui::IsItemDeactivatedAfterEdit();
  }
  return changed;
}

void EditorPanel::draw_entry(CaseEditor& editor) {
  heading("Planned entry");
  quiet("Click on the skin in the room, or near it in a plane: it snaps to the skin.");
  const auto& entry = editor.row().planned_entry_lps_mm;
  if (!entry) {
    ImGui::TextUnformatted("none is planned");
    return;
  }
  ImGui::Text("at %.1f, %.1f, %.1f mm", entry->x, entry->y, entry->z);
  ImGui::SameLine();
  if (ImGui::Button("Remove (Del)")) editor.set_entry(std::nullopt);
  const auto scene = editor.scene();
  if (!scene || !scene->way) return;
  const session::PlannedWay& way = *scene->way;
  ImGui::PushTextWrapPos(0.0F);
  ImGui::Text("%.0f mm to the target's middle; the needle is %.0f mm long", way.length_mm,
              editor.row().instrument.length_mm);
  ImGui::Text("%.0f° off perpendicular to the skin, %.0f° towards the %s", way.skin_angle_deg,
              std::abs(way.head_deg), way.head_deg < 0.0 ? "feet" : "head");
  for (const session::WayPart& part : way.parts) {
    const ImVec4 colour = part.forbidden ? ImVec4(1.0F, 0.45F, 0.35F, 1.0F) : ImVec4(0.75F, 0.80F, 0.84F, 1.0F);
    ImGui::TextColored(colour, "%.0f to %.0f mm: %s", part.from_mm, part.from_mm + part.length_mm,
                       part.what.c_str());
  }
  for (const std::string& one : way.not_crossed)
    ImGui::TextColored({1.0F, 0.45F, 0.35F, 1.0F}, "does not cross %s", one.c_str());
  if (way.free()) ImGui::TextColored({0.45F, 0.85F, 0.55F, 1.0F}, "free of bone, gas and structures");
  ImGui::PopTextWrapPos();
}

bool EditorPanel::draw_setting(const casedb::SettingRow& row) {
  using namespace casedb;
  const char* const label = row.editor.words;
  const std::string format = "%." + std::to_string(row.editor.digits) + "f";
  return std::visit(
      OfKind{[&](const NumberField& one) {
               double value = one.get(setting_);
               const bool changed = number_field(label, value, row.editor.step, format.c_str(), setting_in_hand_);
               one.set(setting_, value);
               return changed;
             },
             [&](const MaybeNumberField& one) {
               std::optional<double> value = one.get(setting_);
               const bool changed =
                   optional_number(label, value, row.editor.usual, format.c_str(), setting_in_hand_);
               one.set(setting_, value);
               return changed;
             },
             [&](const MaybeWholeField& one) {
               const std::optional<int> before = one.get(setting_);
               std::optional<double> value = before ? std::optional<double>(*before) : std::nullopt;
               const bool changed = optional_number(label, value, row.editor.usual, "%.0f", setting_in_hand_);
               one.set(setting_, value ? std::optional(static_cast<int>(std::clamp(std::round(*value), -1.0, 1e6)))
                                       : std::nullopt);
               return changed;
             },
             [&](const TextField& one) {
               TextInHand& text = texts_[row.column];
               fill(text.typed, text.filled_from, one.get(setting_));
               ImGui::SetNextItemWidth(-scaled(60.0F));
               ImGui::InputText(label, text.typed.data(), text.typed.size());
               note_item(label);
               if (!ImGui::IsItemDeactivatedAfterEdit()) return false;
               one.set(setting_, text.filled_from = text.typed.data());
               return true;
             },
             [&](const ChoiceField& one) {
               const auto words = row.editor.names.empty() ? one.names : row.editor.names;
               const auto now = static_cast<std::size_t>(
                   std::find(one.names.begin(), one.names.end(), one.get(setting_)) - one.names.begin());
               ImGui::SetNextItemWidth(scaled(kFieldPx));
               if (!begin_choice(label, std::string(words[now]))) return false;
               bool changed = false;
               for (std::size_t i = 0; i < words.size(); ++i)
                 if (ImGui::Selectable(std::string(words[i]).c_str(), i == now))
                   changed = one.set(setting_, one.names[i]) || changed;
               ImGui::EndCombo();
               return changed;
             },
             [&](const SwitchField& one) {
               bool value = one.get(setting_);
               const bool changed = ImGui::Checkbox(label, &value);
               note_item(label);
               one.set(setting_, value);
               return changed;
             },
             [&](const ComposedField& one) {
               if (one.what == Composed::further_modalities) return draw_further(label, setting_);
               return one.what == Composed::gauge && draw_gauge(label, setting_.instrument);
             }},
      row.field);
}

void EditorPanel::draw_rule_and_setting(CaseEditor& editor) {
  if (!setting_in_hand_) setting_ = editor.row();
  setting_in_hand_ = false;
  const bool rule_changed = draw_rule(editor);
  ImGui::Spacing();
  const bool setting_changed = draw_setting(editor);
  if (!rule_changed && !setting_changed) return;
  editor.set_setting(setting_, rule_changed ? "pass rule changed" : "setting changed");
  setting_in_hand_ = false;
}

bool EditorPanel::draw_rule(const CaseEditor& editor) {
  bool changed = false;
  heading("To pass");
  std::optional<std::size_t> drop;
  for (std::size_t i = 0; i < setting_.rule.criteria.size(); ++i) {
    assessment::Criterion& one = setting_.rule.criteria[i];
    ImGui::PushID(static_cast<int>(i));
    const assessment::MetricInfo* info = assessment::find_metric(one.metric);
    ImGui::TextUnformatted(metric_words(one.metric).c_str());
    if (info != nullptr && ImGui::IsItemHovered()) ImGui::SetTooltip("%s: %s", info->id, info->definition);
    ImGui::SetNextItemWidth(scaled(58.0F));
    if (ImGui::BeginCombo("##sign", std::string(assessment::sign_of(one.comparison)).c_str())) {
      for (const auto sign :
           {assessment::Comparison::at_least, assessment::Comparison::at_most, assessment::Comparison::equal})
        if (ImGui::Selectable(std::string(assessment::sign_of(sign)).c_str(), sign == one.comparison)) {
          one.comparison = sign;
          changed = true;
        }
      ImGui::EndCombo();
    }
    ImGui::SameLine();
    ImGui::SetNextItemWidth(scaled(86.0F));
    ImGui::InputDouble("##value", &one.value, 0.0, 0.0, "%.6g");
    setting_in_hand_ = setting_in_hand_ || ImGui::IsItemActive();
    changed = changed || ImGui::IsItemDeactivatedAfterEdit();
    ImGui::SameLine();
    ImGui::TextDisabled("%-5s", info != nullptr ? info->unit : "");
    ImGui::SameLine();
    changed = ImGui::Checkbox("critical", &one.critical) || changed;
    ImGui::SameLine();
    if (ImGui::Button("drop")) drop = i;
    ImGui::PopID();
  }
  // Dropped once all are drawn: the list must not change under the loop.
  if (drop) {
    setting_.rule.criteria.erase(setting_.rule.criteria.begin() + static_cast<std::ptrdiff_t>(*drop));
    changed = true;
  }
  ImGui::SetNextItemWidth(-1.0F);
  const bool open = ImGui::BeginCombo("##more", "one more criterion …", ImGuiComboFlags_HeightLarge);
  if (!open) note_item("one more criterion");
  if (open) {
    const auto scene = editor.scene();
    for (const std::string& id : scene ? scene->check.rule_may_name : std::vector<std::string>{}) {
      if (!ImGui::Selectable((metric_words(id) + "##" + id).c_str())) continue;
      const assessment::MetricInfo* info = assessment::find_metric(id);
      assessment::Criterion more;
      more.metric = id;
      if (info != nullptr) more = assessment::usual_criterion(*info, setting_.sight_law);
      setting_.rule.criteria.push_back(more);
      changed = true;
    }
    ImGui::EndCombo();
  }
  return changed;
}

bool EditorPanel::draw_setting(CaseEditor& editor) {
  bool changed = false;
  heading("The case");
  fill(title_, title_of_, editor.row().title);
  ImGui::SetNextItemWidth(-scaled(60.0F));
  ImGui::InputText("title", title_.data(), title_.size());
  note_item("title");
  const bool titled = ImGui::IsItemDeactivatedAfterEdit();
  static const std::vector<const casedb::SettingRow*> kRows = casedb::shown_rows(&casedb::SettingRow::editor);
  for (const casedb::SettingRow* row : kRows) changed = draw_setting(*row) || changed;
  if (editor.row().modality == cases::Modality::xray && editor.row().sight_law >= cases::SightLaw::scatter)
    quiet("Fluoroscopy: scatter from the patient hazes the picture; narrowing the collimator makes it clearer.");
  if (titled) editor.set_title(title_.data());
  return changed;
}

void EditorPanel::draw_tool(CaseEditor& editor) {
  ImGui::BeginDisabled(!editor.locked().empty());
  switch (editor.tool) {
    case EditorTool::look:
      heading("Look");
      quiet("Click: the cursor goes there, in all planes. Wheel: slice by slice. H: all keys.");
      draw_history(editor);
      break;
    case EditorTool::lesion:
      draw_lesion(editor);
      break;
    case EditorTool::structure:
      draw_structure(editor);
      break;
    case EditorTool::entry:
      draw_entry(editor);
      break;
    case EditorTool::rule:
      draw_rule_and_setting(editor);
      break;
    case EditorTool::prepare:
      break;  // of a published case too: it becomes another draft
  }
  ImGui::EndDisabled();
  if (editor.tool == EditorTool::prepare) draw_preparation(editor);
}

}  // namespace seldinger::app
