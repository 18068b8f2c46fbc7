#include "app/draw/plot/derived_signals.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/file/text/text.h"

namespace hapticwall::draw {
namespace {

constexpr std::string_view kSeconds = " s";

PlottedLine source_of(Quantity quantity) { return *usual_plots().find(quantity); }

// "0.05 s", or "0.05".
std::optional<double> time_in(std::string_view text) {
  if (text.ends_with(kSeconds)) text.remove_suffix(kSeconds.size());
  return file::parsed<double>(text);
}

std::optional<DerivedSignal> derived_of(DerivedKind kind, std::string_view inside) {
  const std::string_view between = kind_text(kind).between;
  const std::size_t end = between.empty() ? inside.size() : inside.find(between);
  if (end == std::string_view::npos) return std::nullopt;
  const std::string_view second = inside.substr(std::min(end + between.size(), inside.size()));
  const auto a = usual_plots().find(inside.substr(0, end));
  const auto b = kind == DerivedKind::kDifference ? usual_plots().find(second) : a;
  const auto over_s = kind == DerivedKind::kMean ? time_in(second) : DerivedSignal().over_s;
  if (!a || !b || !over_s) return std::nullopt;
  const DerivedSignal signal{kind, a->line->quantity, b->line->quantity, *over_s};
  return derived_problem(signal, {}) ? std::nullopt : std::optional(signal);
}

}  // namespace

std::string derived_name(const DerivedSignal& signal) {
  const DerivedKindText& text = kind_text(signal.kind);
  std::string second;
  if (signal.kind == DerivedKind::kDifference) second = source_of(signal.b).line->name;
  if (signal.kind == DerivedKind::kMean) second = fmt::format("{}{}", signal.over_s, kSeconds);
  return fmt::format("{}({}{}{})", text.name, source_of(signal.a).line->name, text.between, second);
}

std::optional<DerivedSignal> derived_called(std::string_view name) {
  const std::size_t open = std::min(name.find('('), name.size());
  const auto kind = std::ranges::find(kDerivedKinds, name.substr(0, open), &DerivedKindText::name);
  if (kind == kDerivedKinds.end() || !name.ends_with(')')) return std::nullopt;
  return derived_of(static_cast<DerivedKind>(kind - kDerivedKinds.begin()),
                    name.substr(open + 1, name.size() - open - 2));
}

bool add_derived(const DerivedSignal& signal, DerivedSignals& all, ChosenLines& chosen) {
  if (std::ranges::find(all, signal) != all.end()) return false;
  const auto place = std::ranges::find(all, std::optional<DerivedSignal>());
  if (place == all.end()) return false;
  *place = signal;
  const Quantity quantity = Quantity::derived_signal(static_cast<std::size_t>(place - all.begin()));
  chosen[static_cast<std::size_t>(source_of(signal.a).plot->id)] |= line_bit(quantity);
  return true;
}

void remove_derived(std::size_t place, DerivedSignals& all, ChosenLines& chosen,
                    HiddenLines& hidden) {
  const LineSet bit = line_bit(Quantity::derived_signal(place));
  all.at(place).reset();
  for (LineSet& lines : chosen) lines &= ~bit;
  hidden &= ~bit;
}

std::optional<std::string> derived_problem(const DerivedSignal& signal, const MeanLimits& limits) {
  const PlottedLine a = source_of(signal.a);
  const PlottedLine b = source_of(signal.b);
  if (signal.kind == DerivedKind::kMean &&
      !(signal.over_s > 0.0 && signal.over_s >= limits.tick_s && signal.over_s <= limits.window_s))
    return fmt::format("the time must be one tick ({:g} s) to the length of the time axes ({:g} s)",
                       limits.tick_s, limits.window_s);
  if (signal.kind != DerivedKind::kDifference) return std::nullopt;
  if (signal.a == signal.b) return "choose two signals: a signal minus itself is 0";
  const std::string_view unit_a = a.scale().unit;
  const std::string_view unit_b = b.scale().unit;
  if (unit_a == unit_b) return std::nullopt;
  return fmt::format("{} is in {}, {} in {}: choose two of one unit", a.line->name, unit_a,
                     b.line->name, unit_b);
}

}  // namespace hapticwall::draw
