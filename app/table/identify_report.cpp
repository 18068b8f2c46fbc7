#include "app/table/identify_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/file/text/text.h"
#include "app/table/json_report.h"
#include "core/units.h"

namespace hapticwall::table {
namespace {

using identify::Estimate;
using identify::Identification;

std::string row(std::string_view name, const Estimate& estimate, double scale,
                std::string_view unit) {
  return fmt::format("{:<28}{:>11.5g} {:<6}{:>11.5g} to {:.5g}\n", name, estimate.value * scale,
                     unit, estimate.low * scale, estimate.high * scale);
}

std::string span(const Estimate& estimate) {
  return fmt::format("{:.6g} to {:.6g}", estimate.low, estimate.high);
}

// The motion stays the same if force, m, b and f_c have a common factor.
constexpr std::string_view kForceScaleNote =
    "An error of the device's force scale goes unseen into m, b and f_c.";

Json estimate_object(const Estimate& estimate) {
  return {{"value", estimate.value}, {"low", estimate.low}, {"high", estimate.high}};
}

// A value with the digits that its interval supports and one more.
double rounded(const Estimate& estimate) {
  return std::stod(fmt::format("{:.6g}", estimate.value));
}

}  // namespace

std::string identify_text(const IdentifiedBy& by, const Identification& found) {
  std::string text =
      fmt::format("{}: {:.3g} s of strokes at up to {:.3g} N, {} turns, {} ticks missed\n\n",
                  by.device, by.seconds, by.force_limit_n, by.turns, by.missed_ticks);
  if (!found.fits) {
    return text + fmt::format(
                      "this model does not fit: the residuals are {:.2f} times those of "
                      "the encoder's counts\n",
                      found.residual_ratio);
  }
  text += fmt::format("{:<28}{:>11} {:<6}{:>11}\n", "", "value", "", "95 % interval");
  text += row("moving mass m", found.mass_kg, 1.0, "kg");
  text += row("viscous damping b", found.damping_n_s_per_m, 1.0, "N s/m");
  text += row("Coulomb friction f_c", found.friction_n, 1.0, "N");
  text += row("  towards larger x", found.friction_up_n, 1.0, "N");
  text += row("  towards smaller x", found.friction_down_n, 1.0, "N");
  text += row("delay and lag of the force", found.delay_s, kMillisecondsPerSecond, "ms");
  text += fmt::format("  {} whole ticks (possible: {}), then a lag of {:.3g} ms\n",
                      found.delay_ticks, fmt::join(found.possible_delays, ", "),
                      found.lag_s.value * kMillisecondsPerSecond);
  text +=
      fmt::format("{:<28}{:>11.5g} um, noise {:.3g} um\n", "encoder count",
                  found.encoder_m * kMicrosecondsPerSecond, found.noise_m * kMicrosecondsPerSecond);
  text += fmt::format("{:<28}{:>11.4f} of the encoder's counts and noise\n", "residuals",
                      found.residual_ratio);
  return text + fmt::format("{}\n", kForceScaleNote);
}

std::string identify_json(const IdentifiedBy& by, const Identification& found) {
  Json object = {{"device", by.device},
                 {"date", by.date},
                 {"force_limit_n", by.force_limit_n},
                 {"seconds", by.seconds},
                 {"turns", by.turns},
                 {"missed_ticks", by.missed_ticks},
                 {"fits", found.fits},
                 {"residual_ratio", found.residual_ratio},
                 {"encoder_m", found.encoder_m},
                 {"noise_m", found.noise_m}};
  const auto add = [&](const char* name, const Estimate& estimate) {
    object[name] = found.fits ? estimate_object(estimate) : Json();
  };
  add("mass_kg", found.mass_kg);
  add("damping_n_s_per_m", found.damping_n_s_per_m);
  add("friction_n", found.friction_n);
  add("friction_up_n", found.friction_up_n);
  add("friction_down_n", found.friction_down_n);
  add("delay_s", found.delay_s);
  add("lag_s", found.lag_s);
  object["delay_ticks"] = found.fits ? Json(found.delay_ticks) : Json();
  object["possible_delays"] = found.fits ? Json(found.possible_delays) : Json();
  object["note"] = found.fits ? Json(kForceScaleNote) : Json();
  return object.dump(2) + "\n";
}

std::string misfit_text(const IdentifiedBy& by) {
  return fmt::format(
      "{}: this model does not fit, so there are no numbers; let go of the handle, clear its way, "
      "and look for play",
      by.device);
}

std::string written_text(const std::string& path) {
  return fmt::format("{0}: written; a scene names it with device = \"{0}\"", file::shown(path));
}

std::string identified_line(const IdentifiedBy& by, const Identification& found) {
  return fmt::format(
      "{}, 95 % intervals if the force scale is right: m {} kg, b {} N s/m, f_c {} N, delay and "
      "lag "
      "{} s; residuals {:.3f} of the encoder's, up to {:.3g} N",
      by.date, span(found.mass_kg), span(found.damping_n_s_per_m), span(found.friction_n),
      span(found.delay_s), found.residual_ratio, by.force_limit_n);
}

file::DeviceDescription identified_device(file::DeviceDescription device, const IdentifiedBy& by,
                                          const Identification& found) {
  device.identified = identified_line(by, found);
  if (device.x.encoder_m <= 0.0) device.x.encoder_m = found.encoder_m;
  device.x.mass_kg = rounded(found.mass_kg);
  device.x.damping_n_s_per_m = rounded(found.damping_n_s_per_m);
  device.x.friction_n = rounded(found.friction_n);
  if (device.ff) {
    device.ff->delay_s = rounded(found.delay_s);
    device.ff->delay_date = by.date.substr(0, by.date.find('T'));
  }
  return device;
}

}  // namespace hapticwall::table
