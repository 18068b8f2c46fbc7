// The search for a hand that takes energy.
#include "core/study/worst_hand/worst_hand.h"

#include <fmt/format.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "app/python/interruptible.h"
#include "app/python/law.h"
#include "app/python/runs.h"

namespace hapticwall::python {
namespace {

using worst_hand::Found;

worst_hand::Plan plan_of(const SceneBox& box, const HandSearch& search) {
  const auto index_of = [](const auto& names, std::string_view name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
  };
  worst_hand::Plan plan{axis_scene(scene_of_study(box), 0), search.hands, search.seed};
  const std::size_t bounds = index_of(worst_hand::kBoundsNames, search.bounds);
  const std::size_t motion = index_of(worst_hand::kMotionNames, search.motion);
  if (bounds == worst_hand::kBoundsNames.size())
    raise(usage_error("bounds: \"wide\" or \"narrow\""));
  if (motion == worst_hand::kMotionNames.size())
    raise(usage_error("motion: \"let-go\" or \"ramp\""));
  if (search.hands == 0 || search.hands > worst_hand::kMaxHands)
    raise(usage_error(fmt::format("hands: 1 to {}", worst_hand::kMaxHands)));
  if (search.threads < 0) raise(usage_error("threads: 0 or more"));
  plan.bounds = static_cast<worst_hand::Bounds>(bounds);
  plan.motion = static_cast<worst_hand::Motion>(motion);
  if (const auto problem = worst_hand::problem_of(plan.scene, plan.bounds))
    raise(usage_error(problem->key + ": " + problem->message));
  return plan;
}

nanobind::object none_or(const std::optional<double>& value) {
  return value ? nanobind::cast(*value) : nanobind::none();
}

void add_hand(HandDict& dict, const Found& found, const worst_hand::Plan& plan) {
  using worst_hand::kHandNumberList;
  const worst_hand::FoundHand& hand = *found.hand;
  dict["most_j"] = found.most_j();
  dict["typical_j"] = hand.typical_j;
  dict["least_j"] = hand.least_j;
  dict["taken_j"] = hand.taken_j;
  dict["taken_at_rest_j"] = hand.taken_at_rest_j;
  dict["last_second_w"] = none_or(hand.last_second_w);
  nanobind::dict numbers;
  nanobind::list at_bound;
  for (std::size_t i = 0; i < worst_hand::number_count(plan.motion); ++i) {
    const std::string_view key = kHandNumberList.at(i).key;
    numbers[nanobind::cast(key)] = hand.values.at(i);
    if (worst_hand::is_at_bound(hand.values, i, plan.bounds)) at_bound.append(key);
  }
  dict["numbers"] = numbers;
  dict["at_bound"] = at_bound;
  file::LoadedScene loaded;
  loaded.scene = hand.scene;
  dict["scene"] = SceneBox(std::move(loaded));
}

// Values of one type, as the bytes that travel between processes of one build.
template <typename T>
nanobind::bytes as_bytes(std::span<const T> values) {
  return nanobind::bytes(values.data(), values.size_bytes());
}
template <typename T>
std::vector<T> from_bytes(const nanobind::bytes& bytes) {
  if (bytes.size() % sizeof(T) != 0) raise(usage_error("hands: not from this build"));
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}
static_assert(sizeof(worst_hand::HandResult) == 3 * sizeof(double));

// Asks Python for the results of hands. An exception ends the search and is kept.
class Elsewhere {
 public:
  explicit Elsewhere(std::optional<nanobind::callable> function) : function_(std::move(function)) {}

  std::optional<worst_hand::HandResults> run(std::span<const worst_hand::HandValues> hands) {
    const nanobind::gil_scoped_acquire locked;
    try {
      const nanobind::object answer = (*function_)(as_bytes(hands));
      worst_hand::HandResults results;
      for (const auto& result :
           from_bytes<worst_hand::HandResult>(nanobind::cast<nanobind::bytes>(answer)))
        results.push_back(std::isnan(result.score) ? std::nullopt : std::optional(result));
      if (results.size() == hands.size()) return results;
      raise(usage_error("hands: results are missing"));
    } catch (nanobind::python_error& error) {
      raised_.emplace(std::move(error));
      return std::nullopt;
    }
  }
  void throw_raised() {
    if (raised_) throw std::move(*raised_);
  }

 private:
  std::optional<nanobind::callable> function_;
  std::optional<nanobind::python_error> raised_;
};

}  // namespace

nanobind::bytes run_hands(const SceneBox& box, const HandSearch& search,
                          const nanobind::bytes& hands) {
  const worst_hand::Plan plan = plan_of(box, search);
  const auto values = from_bytes<worst_hand::HandValues>(hands);
  const int threads = scene_takes_lock(plan.scene) ? 1 : search.threads;
  const auto results = interruptibly([&](const StopQuestion& should_stop) {
    worst_hand::SearchOptions options;
    options.threads = threads;
    options.should_stop = should_stop;
    return worst_hand::run_hands(plan, values, options);
  });
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<worst_hand::HandResult> numbers;
  for (const auto& result : *results)
    numbers.push_back(result.value_or(worst_hand::HandResult{kNone, kNone, kNone}));
  return as_bytes(std::span<const worst_hand::HandResult>(numbers));
}

HandDict search_hand(const SceneBox& box, const HandSearch& search) {
  const worst_hand::Plan plan = plan_of(box, search);
  const int threads = scene_takes_lock(plan.scene) ? 1 : search.threads;
  Elsewhere elsewhere(search.elsewhere);
  const std::optional<Found> found = interruptibly([&](const StopQuestion& should_stop) {
    worst_hand::SearchOptions options;
    options.threads = threads;
    options.should_stop = should_stop;
    if (search.elsewhere) {
      options.run_hands = [&](const auto& hands) {
        return should_stop() ? std::nullopt : elsewhere.run(hands);
      };
    }
    return worst_hand::search(plan, options);
  });
  elsewhere.throw_raised();
  HandDict dict;
  dict["hands"] = found->hands;
  dict["refused_hands"] = found->refused;
  dict["first_hand"] = found->first() ? nanobind::cast(*found->first()) : nanobind::none();
  if (found->hand) add_hand(dict, *found, plan);
  return dict;
}

}  // namespace hapticwall::python
