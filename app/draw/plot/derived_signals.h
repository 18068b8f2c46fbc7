// Derived signals as the user writes and reads them.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "app/draw/plot/plot_lines.h"

namespace hapticwall::draw {

// In the order of DerivedKind.
struct DerivedKindText {
  std::string_view name;
  std::string_view between;  // its two arguments; empty: it has one
  const char* meaning;
};
inline constexpr std::array kDerivedKinds{
    DerivedKindText{"difference", " - ", "One signal minus another one of the same unit"},
    DerivedKindText{"mean", " over ", "Mean of the ticks in a time that ends at each sample"},
    DerivedKindText{"derivative", "", "Change over one tick, per second"}};

[[nodiscard]] constexpr const DerivedKindText& kind_text(DerivedKind kind) {
  return kDerivedKinds.at(static_cast<std::size_t>(kind));
}

// In the legend and in the settings: "derivative(handle)", "mean(actuator F_d over 0.05 s)",
// "difference(hand - handle)". The names are those of the lines.
[[nodiscard]] std::string derived_name(const DerivedSignal& signal);
// The reverse; nullopt for any other text and for a signal that has a problem.
[[nodiscard]] std::optional<DerivedSignal> derived_called(std::string_view name);

// Puts it at a free place, and chooses its line in its plot. False if it is there already, or if
// there is no place.
bool add_derived(const DerivedSignal& signal, DerivedSignals& all, ChosenLines& chosen);
// The reverse; another signal at this place is not hidden.
void remove_derived(std::size_t place, DerivedSignals& all, ChosenLines& chosen,
                    HiddenLines& hidden);

// The limits of a mean's time, s.
struct MeanLimits {
  double tick_s = 0.0;
  double window_s = 3600.0;  // the length of the time axes
};

// Why it cannot be drawn, for people; nullopt if it can.
[[nodiscard]] std::optional<std::string> derived_problem(const DerivedSignal& signal,
                                                         const MeanLimits& limits);

}  // namespace hapticwall::draw
