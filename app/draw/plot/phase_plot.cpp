#include "app/draw/plot/phase_plot.h"

#include <implot.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "app/draw/axis/axis_titles.h"
#include "app/draw/axis/ticks.h"
#include "core/units.h"

namespace hapticwall::draw {
namespace {

constexpr double kMinSpanMm = 0.05;
constexpr double kMinSpanN = 1.0;

// The range of one coordinate of the path: without free motion, with 0, which every plane
// shows.
Extremes extremes_of(const PhasePath& path, const std::vector<double>& values, double scale) {
  Extremes all;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (path.force_n[i] == 0.0 && path.penetration_m[i] <= 0.0) continue;
    all.include({values[i] * scale, values[i] * scale});
  }
  return all;
}

void toggle(const PlotSurface& surface, const char* label, bool& value, const char* tooltip) {
  ImGui::SameLine();
  begin_choice(*surface.theme, value);
  const bool clicked = ImGui::SmallButton(label);
  end_choice();
  if (clicked) value = !value;
  ImGui::SetItemTooltip("%s", tooltip);
}

void draw_energy(const PlotSurface& surface, const PhaseView& view, bool whole) {
  const double energy_mj = view.energy_j * kMillijoulesPerJoule;
  const bool gave = energy_mj < 0.0;
  const Tone tone = gave ? Tone::kBad : Tone::kGood;
  ImGui::TextColored(surface.theme->colour(tone), "%s %.4g mJ", gave ? "out" : "in",
                     std::abs(energy_mj));
  if (surface.interactive) {
    ImGui::SetItemTooltip(
        "The area of the path, ∫ F dp, of %zu samples.\n"
        "in: the handle has put energy into the wall; out: the wall has given it energy.",
        view.samples);
  }
  if (whole) return;
  ImGui::SameLine();
  ImGui::TextDisabled("newest %zu samples", view.samples);
}

void draw_heading(const PlotSurface& surface, PhaseSettings& settings, const PhaseView& view,
                  bool whole) {
  strong_text(*surface.theme, "Force over penetration");
  const FontScope font(nullptr, kSmallFontSize);
  draw_energy(surface, view, whole);
  if (!surface.interactive) return;
  toggle(surface, "last contact", settings.last_contact,
         "Only the newest contact of the visible range");
  if (!surface.simulated) return;
  toggle(surface, "true", settings.true_position,
         "Over the true penetration, which only a simulator knows,\n"
         "instead of the measured one");
}

// The walls' static force: straight pieces that bend at each face.
void draw_walls(const PlotSurface& surface) {
  if (surface.walls.empty()) return;
  const double face_m = surface.walls.front().position_m;
  const double deepest_m = ImPlot::GetPlotLimits().X.Max / kMillimetresPerMetre;
  std::vector<double> depths_m{0.0, std::max(deepest_m, 0.0)};
  for (const WallSettings& wall : surface.walls) depths_m.push_back(wall.position_m - face_m);
  std::sort(depths_m.begin(), depths_m.end());
  PhasePath line;
  for (const double depth_m : depths_m) {
    double force_n = 0.0;
    for (const WallSettings& wall : surface.walls) {
      const double into_m = depth_m - (wall.position_m - face_m);
      force_n += std::max(into_m, 0.0) * wall.stiffness_n_per_m;
    }
    line.add(depth_m * kMillimetresPerMetre, force_n);
  }
  ImPlot::PlotLine("##wall", line.penetration_m.data(), line.force_n.data(),
                   static_cast<int>(line.penetration_m.size()),
                   line_spec(with_alpha(surface.theme->colour(Tone::kWall), 0.7F)));
}

int pixel_of(float place) {
  constexpr float kFar = 1e5F;  // far outside the plot
  return static_cast<int>(std::floor(std::clamp(place, -kFar, kFar)));
}

void trace_pixels(PhaseView& view) {
  view.rows.clear();
  view.columns.clear();
  ImVec2 before;
  for (std::size_t i = 0; i < view.path.force_n.size(); ++i) {
    const ImVec2 now = ImPlot::PlotToPixels(view.path.penetration_m[i] * kMillimetresPerMetre,
                                            view.path.force_n[i]);
    if (i > 0) {
      const auto [left, right] = std::minmax({pixel_of(before.x), pixel_of(now.x)});
      const auto [top, bottom] = std::minmax({pixel_of(before.y), pixel_of(now.y)});
      if (view.path.force_n[i] == view.path.force_n[i - 1]) {
        view.rows.push_back({top, left, right + 1});
      } else {
        view.columns.push_back({left, top, bottom + 1});
      }
    }
    before = now;
  }
  join_spans(view.rows);
  join_spans(view.columns);
}

void draw_path(const PlotSurface& surface, PhaseView& view) {
  if (view.path.force_n.empty()) return;
  trace_pixels(view);
  ImDrawList* list = ImPlot::GetPlotDrawList();
  const ImU32 colour = surface.theme->packed(Tone::kForce);
  const auto rectangle = [&](int left, int top, int right, int bottom) {
    list->PrimRect(ImVec2(static_cast<float>(left), static_cast<float>(top)),
                   ImVec2(static_cast<float>(right), static_cast<float>(bottom)), colour);
  };
  const int weight = std::max(1, static_cast<int>(std::lround(surface.line_weight)));
  ImPlot::PushPlotClipRect();
  const auto count = static_cast<int>(view.rows.size() + view.columns.size());
  list->PrimReserve(6 * count, 4 * count);
  for (const PixelSpan& row : view.rows) rectangle(row.from, row.line, row.to, row.line + weight);
  for (const PixelSpan& column : view.columns)
    rectangle(column.line, column.from, column.line + weight, column.to);
  // The path's end: the present, while the plots follow.
  const ImVec2 tip = ImPlot::PlotToPixels(view.path.penetration_m.back() * kMillimetresPerMetre,
                                          view.path.force_n.back());
  list->AddCircleFilled(tip, 2.5F * surface.line_weight, surface.theme->packed(Tone::kText));
  ImPlot::PopPlotClipRect();
}

PlotArea draw_plane(const PlotSurface& surface, PhaseView& view, ImVec2 size) {
  const FontScope font(surface.theme->fonts.digits, kSmallFontSize);
  if (!ImPlot::BeginPlot("##plot Phase", size, plot_flags(surface.interactive))) return {};
  const bool prints = surface.theme->prints();
  view.penetration.set_up(ImAxis_X1, prints ? "%g" : "%g mm");
  view.force.set_up(ImAxis_Y1, prints ? "%g" : "%g N");
  if (prints) {
    set_up_ticks(ImAxis_X1,
                 ticks_across(view.penetration.minimum, view.penetration.maximum, size.x));
    set_up_ticks(ImAxis_Y1,
                 round_ticks(view.force.minimum, view.force.maximum, max_ticks_up(size.y)));
  }
  ImPlot::SetupFinish();
  draw_walls(surface);
  draw_path(surface, view);
  if (surface.interactive) {
    view.penetration.notice_input(ImAxis_X1);
    view.force.notice_input(ImAxis_Y1);
  }
  const PlotArea area{ImPlot::GetPlotPos(), ImPlot::GetPlotSize()};
  ImPlot::EndPlot();
  return area;
}

PlotArea draw_printed_plane(const PlotSurface& surface, PhaseView& view, ImVec2 size) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const FontScope font(nullptr, kFontSize);
  const ImU32 colour = surface.theme->packed(Tone::kText);
  const std::string force = "force F (N)";
  const float room = title_room(force, size.y);
  const float below = 1.2F * ImGui::GetFontSize();
  ImGui::SetCursorScreenPos({corner.x + room, corner.y});
  const PlotArea area = draw_plane(surface, view, {size.x - room - 0.8F * below, size.y - below});
  draw_upright_title(colour, force, corner.x, room, area.position.y, area.size.y);
  ImGui::SetCursorScreenPos({corner.x, corner.y + size.y - below});
  draw_title_below(colour, "penetration p (mm)", area.position.x, area.size.x);
  return area;
}

}  // namespace

void PhasePath::clear() {
  penetration_m.clear();
  force_n.clear();
}

void PhasePath::add(double at_penetration_m, double at_force_n) {
  penetration_m.push_back(at_penetration_m);
  force_n.push_back(at_force_n);
}

void join_spans(std::vector<PixelSpan>& spans) {
  std::sort(spans.begin(), spans.end(), [](const PixelSpan& a, const PixelSpan& b) {
    return std::tie(a.line, a.from) < std::tie(b.line, b.from);
  });
  std::size_t joined = 0;
  for (const PixelSpan& span : spans) {
    if (joined > 0 && spans[joined - 1].line == span.line && spans[joined - 1].to >= span.from) {
      spans[joined - 1].to = std::max(spans[joined - 1].to, span.to);
    } else {
      spans[joined++] = span;
    }
  }
  spans.resize(joined);
}

void trace_phase(const SampleHistory& history, IndexRange range, bool true_position,
                 PhasePath& path) {
  path.clear();
  double held_n = 0.0;
  for (std::size_t i = range.first; i < range.last; ++i) {
    double penetration_m = history.value(&Sample::penetration_m, i);
    if (true_position) {
      penetration_m +=
          history.value(&PlantTruth::position_m, i) - history.value(&Sample::position_m, i);
    }
    const double force_n = history.value(&Sample::force_n, i);
    if (i > range.first) path.add(penetration_m, held_n);
    if (i == range.first || force_n != held_n) path.add(penetration_m, force_n);
    held_n = force_n;
  }
}

double phase_energy_j(const PhasePath& path) {
  double energy_j = 0.0;
  for (std::size_t i = 1; i < path.force_n.size(); ++i) {
    energy_j += 0.5 * (path.force_n[i] + path.force_n[i - 1]) *
                (path.penetration_m[i] - path.penetration_m[i - 1]);
  }
  return energy_j;
}

IndexRange phase_range(const SampleHistory& history, const PhaseSettings& settings,
                       TimeWindow window) {
  IndexRange range = history.range_within(window.from_s, window.to_s);
  if (settings.last_contact) {
    const auto contact = newest_contact(history, range);
    if (!contact) return {range.last, range.last};
    // One sample more on either side, so that the path begins and ends in front of the wall.
    range = {contact->first - 1, std::min(contact->last + 1, range.last)};
  }
  if (range.count() > kMaxPhaseSamples) range.first = range.last - kMaxPhaseSamples;
  return range;
}

PlotArea draw_phase_plot(const PlotSurface& surface, PhaseSettings& settings, PhaseView& view,
                         ImVec2 size) {
  ImGui::PushID("phase");
  const IndexRange range = phase_range(*surface.history, settings, *surface.window);
  trace_phase(*surface.history, range, settings.true_position && surface.simulated, view.path);
  view.energy_j = phase_energy_j(view.path);
  view.samples = range.count();
  view.penetration.fit(round_range(
      extremes_of(view.path, view.path.penetration_m, kMillimetresPerMetre), kMinSpanMm));
  view.force.fit(round_range(extremes_of(view.path, view.path.force_n, 1.0), kMinSpanN));
  ImGui::BeginGroup();  // starts all rows at the x of the first row
  const float top = ImGui::GetCursorPosY();
  draw_heading(surface, settings, view, range.count() < kMaxPhaseSamples);
  const float height = std::max(1.0F, size.y - (ImGui::GetCursorPosY() - top));
  const PlotArea area = surface.theme->prints()
                            ? draw_printed_plane(surface, view, ImVec2(size.x, height))
                            : draw_plane(surface, view, ImVec2(size.x, height));
  ImGui::EndGroup();
  ImGui::PopID();
  return area;
}

}  // namespace hapticwall::draw
