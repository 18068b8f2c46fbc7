#include "app/command/compare/compare_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "app/command/report/summary_fields.h"
#include "app/file/text/text.h"
#include "app/table/order.h"

namespace hapticwall::command {
namespace {

using table::Place;

Place place_of(std::optional<double> value) {
  if (!value || !std::isfinite(*value)) return {};
  return {false, *value, ""};
}

Place place_of(const SummaryField& field) {
  if (const auto* word = std::get_if<std::string>(&field.value)) {
    // Verdicts sort from good to bad, not alphabetically.
    if (const auto verdict = find_verdict(*word); verdict && field.key.ends_with("verdict")) {
      return place_of(static_cast<double>(*verdict));
    }
    return {false, 0.0, *word};
  }
  if (const auto* integer = std::get_if<std::uint64_t>(&field.value)) {
    return place_of(static_cast<double>(*integer));
  }
  const auto* real = std::get_if<double>(&field.value);
  return real != nullptr ? place_of(*real) : Place{};
}

Place place_by_key(const RunSummary& run, const std::string& key) {
  for (const SummaryField& field : summary_fields(run)) {
    if (field.key == key) return place_of(field);
  }
  return {};
}

// A corner is as good as its worse axis.
Verdict worst_verdict(const RunSummary& run) {
  return std::ranges::max(run, {}, &Summary::verdict).verdict;
}

Place usual_place(const RunSummary& run) {
  const Summary& x = run.front();
  if (!is_good(worst_verdict(run))) return place_of(x.tail_peak_to_peak_m);
  Place place = place_of(x.displayed_stiffness_n_per_m);
  place.number = -place.number;
  return place;
}

}  // namespace

Result<RowOrder> parse_order(const std::string& text) {
  if (text.empty() || text == kUnsorted) return RowOrder{text, false};
  const bool descending = text.front() == '-';
  RowOrder order{text.substr(descending ? 1 : 0), descending};
  const std::vector<SummaryField> known = all_summary_fields();
  if (std::ranges::find(known, order.key, &SummaryField::key) != known.end()) return order;
  return usage_error(fmt::format("--sort {}: {}", file::in_quotes(text), unknown_key(order.key)));
}

std::vector<std::size_t> ordered(const std::vector<RunSummary>& runs, const RowOrder& order) {
  std::vector<std::size_t> indices(runs.size());
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  if (order.key == kUnsorted) return indices;
  const bool usual = order.key.empty();
  std::vector<std::pair<Verdict, Place>> places;
  places.reserve(runs.size());
  for (const RunSummary& run : runs) {
    places.emplace_back(usual ? worst_verdict(run) : Verdict::kSettled,
                        usual ? usual_place(run) : place_by_key(run, order.key));
  }
  std::ranges::stable_sort(indices, [&](std::size_t a, std::size_t b) {
    if (places[a].first != places[b].first) return places[a].first < places[b].first;
    return table::before(places[a].second, places[b].second, order.descending);
  });
  return indices;
}

}  // namespace hapticwall::command
