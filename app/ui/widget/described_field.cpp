#include "app/ui/widget/described_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>

#include "app/file/text/number_name.h"
#include "app/ui/state/text_edit.h"
#include "app/ui/widget/widgets.h"

namespace hapticwall::ui {
namespace {

using Set = std::function<void(std::optional<double>)>;

std::string tooltip_of(const ParameterDescription& parameter) {
  std::string text = fmt::format("{}\n{}", parameter.key, parameter.meaning);
  if (parameter.kind == ParameterKind::kNumber) {
    text +=
        fmt::format("\nfrom {:g} to {:g} {}", parameter.minimum, parameter.maximum, parameter.unit);
  }
  return text + fmt::format("\nempty: {}", parameter.default_text);
}

std::string field_id(const DescribedField& field) { return fmt::format("##{}", field.key); }

void draw_number(const PanelContext& context, const DescribedField& field, const Set& set) {
  const std::string shown = field.value ? rounded_number(*field.value) : std::string();
  const auto text = text_field(context, field_id(field).c_str(),
                               std::string(field.description.default_text), shown);
  if (!text) return;
  if (text->find_first_not_of(' ') == std::string::npos) {
    set(std::nullopt);
    return;
  }
  if (const auto number = parse_number(*text)) {
    set(number);
  } else {
    refuse(context, std::string(field.key), no_number(*text));
  }
}

// A switch or a choice: the default, or one of the words.
void draw_choice(const DescribedField& field, const Set& set) {
  static constexpr std::array<std::string_view, 2> kSwitch{"false", "true"};
  const ParameterDescription& parameter = field.description;
  const std::span<const std::string_view> words = parameter.kind == ParameterKind::kBoolean
                                                      ? std::span<const std::string_view>(kSwitch)
                                                      : parameter.choices;
  const std::string default_word = fmt::format("{} (default)", parameter.default_text);
  const auto chosen = field.value ? static_cast<std::size_t>(*field.value) : words.size();
  const std::string shown = chosen < words.size() ? std::string(words[chosen]) : default_word;
  if (!ImGui::BeginCombo(field_id(field).c_str(), shown.c_str())) return;
  if (ImGui::Selectable(default_word.c_str(), !field.value)) set(std::nullopt);
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (list_choice(fmt::format("{0}###{1} = {0}", words[i], parameter.key),
                    field.value && i == chosen))
      set(static_cast<double>(i));
  }
  ImGui::EndCombo();
}

}  // namespace

void draw_described_field(const PanelContext& context, const DescribedField& field,
                          const Set& set) {
  const ParameterDescription& parameter = field.description;
  const std::string tooltip = tooltip_of(parameter);
  field_label(context, file::key_in_words(parameter.key), tooltip, parameter.unit);
  if (parameter.kind == ParameterKind::kNumber) {
    draw_number(context, field, set);
  } else {
    draw_choice(field, set);
    explain(tooltip);
  }
  unit_label(parameter.unit);
  draw_refusal(context, std::string(field.key));
}

}  // namespace hapticwall::ui
