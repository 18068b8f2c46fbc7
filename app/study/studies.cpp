#include "app/study/studies.h"

#include <algorithm>
#include <array>

namespace hapticwall::study {

std::span<const Study* const> studies() {
  static const std::array kStudies{
      &ranking_study(),
      &accuracy_study(),
      &worst_hand_study(),
      &named_hands_study(),
  };
  return kStudies;
}

const std::string& Study::chosen(const Choices& choices, std::string_view key) const {
  if (const auto found = choices.find(key); found != choices.end()) return found->second;
  return std::ranges::find(options, key, &Option::key)->default_value;
}

}  // namespace hapticwall::study
