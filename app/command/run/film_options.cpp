#include "app/command/run/film_options.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "app/command/common_options.h"
#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

constexpr double kMaxSlow = 1000.0;  // the slowest motion of the window
constexpr double kMaxRateHz = 240.0;

struct LookName {
  std::string_view name;
  draw::Look look;
};
constexpr std::array kLooks{LookName{"dark", draw::Look::kScreen},
                            LookName{"light", draw::Look::kLight},
                            LookName{"print", draw::Look::kPrint}};

// Keeps `value` if the option is not given.
Failure read_number(std::string_view option, const std::string& text, double minimum,
                    double maximum, double& value) {
  if (text.empty()) return {};
  const std::optional<double> read = file::parsed<double>(text);
  if (read && *read >= minimum && *read <= maximum) {
    value = *read;
    return {};
  }
  return usage_error(fmt::format("{} {}: it takes a number from {:g} to {:g}", option,
                                 file::in_quotes(text), minimum, maximum));
}

Failure read_size(const std::string& text, draw::PictureSize& size) {
  if (text.empty()) return {};
  const std::vector<std::string_view> sides = file::split(text, 'x');
  const auto side = [&](std::size_t i) {
    const int pixels = sides.size() == 2 ? file::parsed<int>(sides[i]).value_or(0) : 0;
    return pixels >= draw::kMinFilmSide && pixels <= draw::kMaxFilmSide ? pixels : 0;
  };
  size.width = side(0);
  size.height = side(1);
  if (size.width > 0 && size.height > 0) return {};
  return usage_error(fmt::format("--frames-size {}: it takes pixels as 1280x720, {} to {} a side",
                                 file::in_quotes(text), draw::kMinFilmSide, draw::kMaxFilmSide));
}

Failure read_look(const std::string& text, draw::Look& look) {
  if (text.empty()) return {};
  for (const LookName& known : kLooks) {
    if (known.name != text) continue;
    look = known.look;
    return {};
  }
  const auto names = file::names_of(kLooks, &LookName::name);
  return usage_error(fmt::format("--frames-look {}: unknown look{}; known: {}",
                                 file::in_quotes(text), file::suggestion(text, names),
                                 file::joined(names)));
}

Failure check_without_film(const FilmOptions& options) {
  const std::array given{
      std::pair{"--slow", &options.slow},        std::pair{"--frames-from", &options.from},
      std::pair{"--frames-to", &options.to},     std::pair{"--frames-rate", &options.rate},
      std::pair{"--frames-size", &options.size}, std::pair{"--frames-look", &options.look},
      std::pair{"--beside", &options.beside}};
  for (const auto& [name, text] : given) {
    if (!text->empty()) return usage_error(fmt::format("{}: it needs --frames DIR", name));
  }
  return {};
}

Failure check_length(const draw::FilmSettings& settings) {
  if (settings.from_s >= settings.to_s) {
    return usage_error(fmt::format("--frames-from {:g}: the film ends at {:g} s; begin earlier",
                                   settings.from_s, settings.to_s));
  }
  if (settings.picture_count() <= kMaxPictures) return {};
  return usage_error(
      fmt::format("--frames: {:.0f} pictures, and a film has at most {:.0f}; --frames-from, "
                  "--frames-to or a smaller --slow shortens it",
                  settings.picture_count(), kMaxPictures));
}

}  // namespace

void add_film_options(CLI::App& app, std::string& folder, FilmOptions& options) {
  app.add_option("--frames", folder,
                 "Draw a film into a new folder, one PNG for each picture of a screen; needs no "
                 "display")
      ->type_name("DIR");
  app.add_option("--slow", options.slow,
                 "Slow motion of the film: seconds of film for one of the session, 1 to 1000 "
                 "(default: 1)")
      ->type_name("N");
  app.add_option("--beside", options.beside,
                 "Show the run of this algorithm, too, beside the other one")
      ->type_name("NAME")
      ->transform(loads_plugin());
  app.add_option("--frames-from", options.from, "Begin the film at this second of the session")
      ->type_name("S");
  app.add_option("--frames-to", options.to, "End the film at this second of the session")
      ->type_name("S");
  app.add_option("--frames-rate", options.rate, "Pictures in a second of the film (default: 60)")
      ->type_name("HZ");
  app.add_option("--frames-size", options.size, "Pixels of a picture (default: 1280x720)")
      ->type_name("WxH");
  app.add_option("--frames-look", options.look, "dark, light or print (default: dark)")
      ->type_name("NAME");
}

Result<draw::FilmSettings> film_settings(const std::string& folder, const FilmOptions& options,
                                         double duration_s) {
  draw::FilmSettings settings;
  if (folder.empty()) {
    if (Failure failed = check_without_film(options)) return *failed;
    return settings;
  }
  settings.to_s = duration_s;
  const auto number = [](std::string_view option, const std::string& text, double minimum,
                         double maximum, double& value) {
    return read_number(option, text, minimum, maximum, value);
  };
  Failure failed = number("--slow", options.slow, 1.0, kMaxSlow, settings.slow);
  if (!failed) failed = number("--frames-rate", options.rate, 1.0, kMaxRateHz, settings.rate_hz);
  if (!failed) failed = number("--frames-from", options.from, 0.0, duration_s, settings.from_s);
  if (!failed) failed = number("--frames-to", options.to, 0.0, duration_s, settings.to_s);
  if (!failed) failed = read_size(options.size, settings.size);
  if (!failed) failed = read_look(options.look, settings.look);
  if (!failed) failed = check_length(settings);
  if (failed) return *failed;
  return settings;
}

}  // namespace hapticwall::command
