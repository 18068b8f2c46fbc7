#include "app/draw/figure/identify_figure.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/draw/axis/symbol_text.h"
#include "app/draw/figure/page.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr double kShownS = 4.0;
constexpr double kIdentifyPanelMm = 38.0;  // height of a panel

double at_s(const identify::Record& record, std::size_t tick) {
  return static_cast<double>(tick) * record.period_s;
}

FigureCurve curve_of(const identify::Record& record, const std::vector<double>& values,
                     std::size_t first, double scale, std::string name, Tone tone) {
  FigureCurve curve{std::move(name), tone, {}, {}};
  for (std::size_t i = first; i < values.size(); ++i) {
    curve.x.push_back(at_s(record, i));
    curve.y.push_back(values[i] * scale);
  }
  return curve;
}

std::string numbers(const identify::Identification& found) {
  if (!found.fits) {
    return fmt::format("this model does not fit: residuals {:.2f} times the encoder's",
                       found.residual_ratio);
  }
  return fmt::format(
      "m = {:.4g} kg, b = {:.4g} N·s/m, f_c = {:.4g} N, delay and lag {:.4g} ms; residuals {:.3f} "
      "times the encoder's; m, b, f_c if the force scale is right",
      found.mass_kg.value, found.damping_n_s_per_m.value, found.friction_n.value,
      found.delay_s.value * kMillisecondsPerSecond, found.residual_ratio);
}

}  // namespace

std::vector<FigurePanel> identification_panels(const identify::Record& record,
                                               const identify::Identification& found) {
  const auto shown = static_cast<std::size_t>(kShownS / record.period_s);
  const std::size_t count = record.position_m.size();
  const std::size_t first = count - std::min(shown, count);
  FigureCurve model{"model", Tone::kForce, {}, {}};
  std::vector<double> residual_s;
  std::vector<double> residual_counts;
  const std::vector<identify::SegmentNormal> normals = identify::linearise(record, found.fit);
  for (std::size_t s = 0; s < normals.size(); ++s) {
    for (Eigen::Index i = 0; i < normals[s].residual_m.size(); ++i) {
      const std::size_t tick = found.fit.segments[s].first + static_cast<std::size_t>(i);
      const double residual_m = normals[s].residual_m[i];
      residual_s.push_back(at_s(record, tick));
      residual_counts.push_back(residual_m / record.encoder_m);
      if (tick < first) continue;
      model.x.push_back(at_s(record, tick));
      model.y.push_back((record.position_m[tick] - residual_m) * kMillimetresPerMetre);
    }
  }
  return {
      {"position x (mm)",
       {curve_of(record, record.position_m, first, kMillimetresPerMetre, "measured",
                 Tone::kPosition),
        std::move(model)}},
      {"force F (N)", {curve_of(record, record.force_n, first, 1.0, "commanded", Tone::kForce)}},
      {"residual (counts)", {}, spread_of(residual_s, residual_counts)}};
}

Spread spread_of(const std::vector<double>& x, const std::vector<double>& y) {
  constexpr std::size_t kParts = 120;
  constexpr std::size_t kBins = 41;
  constexpr double kTail = 0.05;
  Spread spread;
  if (y.empty()) return spread;
  const std::size_t each = std::max<std::size_t>(y.size() / kParts, 1);
  for (std::size_t first = 0; first < y.size(); first += each) {
    const std::size_t end = std::min(first + each, y.size());
    std::vector<double> part(y.begin() + static_cast<std::ptrdiff_t>(first),
                             y.begin() + static_cast<std::ptrdiff_t>(end));
    std::ranges::sort(part);
    const auto at = [&](double share) {
      return part[static_cast<std::size_t>(
          std::lround(share * static_cast<double>(part.size() - 1)))];
    };
    spread.parts.push_back({x[first], {part.front(), at(kTail), at(1.0 - kTail), part.back()}});
  }
  spread.parts.push_back({x.back(), spread.parts.back().values});
  const auto [low, high] = std::ranges::minmax(y);
  const double width = std::max(high - low, 1e-12) / static_cast<double>(kBins);
  for (std::size_t i = 0; i < kBins; ++i) {
    const double from = low + static_cast<double>(i) * width;
    spread.bins.push_back({from, from + width, 0.0});
  }
  for (const double value : y) {
    const auto bin = std::min(static_cast<std::size_t>((value - low) / width), kBins - 1);
    spread.bins[bin].share += 1.0 / static_cast<double>(y.size());
  }
  return spread;
}

FigureCurve thinned(FigureCurve curve, std::size_t columns) {
  const std::size_t count = curve.y.size();
  const std::size_t part = count / columns + 1;
  if (part <= 2) return curve;
  FigureCurve thin{std::move(curve.name), curve.tone, {}, {}};
  for (std::size_t first = 0; first < count; first += part) {
    const auto begin = curve.y.begin() + static_cast<std::ptrdiff_t>(first);
    const auto ends = std::minmax_element(
        begin, begin + static_cast<std::ptrdiff_t>(std::min(part, count - first)));
    for (const auto place :
         {std::min(ends.first, ends.second), std::max(ends.first, ends.second)}) {
      thin.x.push_back(curve.x[static_cast<std::size_t>(place - curve.y.begin())]);
      thin.y.push_back(*place);
    }
  }
  return thin;
}

Result<file::Picture> draw_identification(const identify::Record& record,
                                          const identify::Identification& found,
                                          const Paper& paper) {
  const std::vector<FigurePanel> panels = identification_panels(record, found);
  return draw_page(paper, [&](const Theme& theme) {
    strong_text(theme, "identification", kTitleFontSize);
    {
      const FontScope font(nullptr, kSmallFontSize);
      wrapped_symbol_text(theme.packed(Tone::kMuted), numbers(found));
    }
    ImGui::Spacing();
    const float height = static_cast<float>(panels.size()) * pixels_of_mm(kIdentifyPanelMm);
    draw_panels(theme, panels, {ImGui::GetContentRegionAvail().x, height});
  });
}

}  // namespace hapticwall::draw
