// The field of a key in [algorithm] or [estimator], drawn from its description.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "app/ui/state/panel_context.h"
#include "core/parameter.h"

namespace hapticwall::ui {

// `key`: with the name of its table, such as estimator.points; it also names the refusal below the
// field.
struct DescribedField {
  std::string_view key;
  const ParameterDescription& description;
  std::optional<double> value;  // nullopt: the default, shown as a hint
};

// Label, field, unit and refusal in one row. Calls `set` with the value that the user enters;
// nullopt for an empty field.
void draw_described_field(const PanelContext& context, const DescribedField& field,
                          const std::function<void(std::optional<double>)>& set);

}  // namespace hapticwall::ui
