// hapticwall map SCENE: the same scene over a grid of two of its numbers, under every algorithm; or
// where along one of them it stops being stable.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/command/commands.h"
#include "app/command/map_axis.h"
#include "app/command/map_boundary.h"
#include "app/command/map_options.h"
#include "app/command/map_report.h"
#include "app/command/output_file.h"
#include "app/command/progress.h"
#include "app/command/signals.h"
#include "app/command/terminal.h"
#include "app/file/map_file.h"
#include "app/file/picture.h"
#include "app/file/sidecar.h"
#include "app/file/text.h"
#include "app/ui/map_figure.h"
#include "core/usage_error.h"

namespace hapticwall::command {
namespace {

// Cells are run in stretches of about so long, each written down at its end.
constexpr double kStretchS = 1.0;
constexpr std::size_t kFirstStretch = 64;
constexpr std::size_t kLongestStretch = 16384;

// "I/N"; the whole map where the option was not given.
Result<file::MapPart> parse_shard(const std::string& text, const StabilityMap& map) {
  if (text.empty()) return file::map_part(map, 1, 1);
  std::size_t index = 0;
  std::size_t count = 0;
  const char* end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, index);
  bool well_formed = first == std::errc{} && slash != end && *slash == '/';
  if (well_formed) {
    const auto [rest, second] = std::from_chars(slash + 1, end, count);
    well_formed = second == std::errc{} && rest == end;
  }
  if (!well_formed || index < 1 || index > count || count > map.cell_count()) {
    return usage_error(
        fmt::format("--shard {}: it takes I/N, part I of N, from 1/N to N/N, and N "
                    "at most the {} cells of the map",
                    file::in_quotes(text), map.cell_count()));
  }
  return file::map_part(map, index, count);
}

Result<StabilityMap> plan_map(const MapOptions& options, Scene scene) {
  Result<MapAxis> x = parse_map_axis("--x", options.x, scene);
  if (!x) return x.error();
  Result<MapAxis> y = parse_map_axis("--y", options.y, scene);
  if (!y) return y.error();
  if (x->number.path == y->number.path) {
    return usage_error(fmt::format("--x and --y are the same key, {}", x->number.path));
  }
  Result<std::vector<std::size_t>> algorithms = chosen_algorithms(options.algorithms);
  if (!algorithms) return algorithms.error();
  StabilityMap map{std::move(scene), std::move(*algorithms), std::move(*x), std::move(*y)};
  if (Failure failed = invalid_cell(validate(map))) return *failed;
  return map;
}

// The cells of a part, those that `writer` found included.
class CellRunner {
 public:
  CellRunner(const StabilityMap& map, const file::MapPart& part,
             std::optional<file::MapWriter>& writer)
      : map_(map), part_(part), writer_(writer) {
    if (writer_) figures_ = writer_->found();
  }

  // False: a signal came.
  [[nodiscard]] Result<bool> run(Progress& progress) {
    const std::size_t found = figures_.size();
    const std::size_t cells = part_.end - part_.begin;
    progress.begin_at(share(found, cells));
    while (figures_.size() < cells) {
      const std::size_t begin = part_.begin + figures_.size();
      const auto start = std::chrono::steady_clock::now();
      const std::vector<MapFigures> figures = run_cells(
          map_, begin, std::min(begin + stretch_, part_.end), [] { return stop_signal() != 0; });
      if (figures.empty()) return false;
      if (writer_) {
        if (Failure failed = writer_->append(map_, begin, figures)) return *failed;
      }
      figures_.insert(figures_.end(), figures.begin(), figures.end());
      progress.show(share(figures_.size(), cells));
      choose_stretch(std::chrono::steady_clock::now() - start);
    }
    return true;
  }
  [[nodiscard]] const std::vector<MapFigures>& figures() const { return figures_; }

 private:
  static double share(std::size_t part, std::size_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  }
  void choose_stretch(std::chrono::duration<double> last) {
    if (last.count() < 0.5 * kStretchS) stretch_ = std::min(2 * stretch_, kLongestStretch);
    if (last.count() > 2.0 * kStretchS) stretch_ = std::max(stretch_ / 2, std::size_t{1});
  }

  const StabilityMap& map_;
  const file::MapPart& part_;
  std::optional<file::MapWriter>& writer_;
  std::vector<MapFigures> figures_;
  std::size_t stretch_ = kFirstStretch;
};

Failure draw(const StabilityMap& map, const std::vector<MapFigures>& figures, OutputFile& plot) {
  if (!plot.is_open()) return {};
  const Result<file::Picture> picture = ui::draw_map(map, figures);
  if (!picture) return picture.error();
  const Result<std::string> bytes = file::encode_png(*picture);
  if (!bytes) return bytes.error();
  return plot.write_whole(*bytes);
}

Failure write_map(const MapOptions& options, const StabilityMap& map, const file::MapPart& part,
                  const std::vector<MapFigures>& figures, OutputFile& json, OutputFile& plot) {
  const std::string text = map_json(map, part.begin, figures);
  if (Failure failed = json.write_whole(text)) return failed;
  if (Failure failed = draw(map, figures, plot)) return failed;
  if (options.output.json == kStandardOutput) return write_output(text);
  if (options.output.quiet) return {};
  return write_output(map_table(map, part.begin, figures));
}

int end_early(const MapOptions& options, std::size_t cells, std::size_t of) {
  const std::string& csv = options.output.csv;
  tell(fmt::format("ended early by {} after {} of {} cells; {}", signal_name(stop_signal()), cells,
                   of,
                   csv.empty() ? "nothing was written"
                               : file::shown(csv) + ".partial holds them, and the same command "
                                                    "goes on from there"));
  return signal_exit_status(stop_signal());
}

int run_map(const MapOptions& options, Scene scene) {
  const Result<StabilityMap> map = plan_map(options, std::move(scene));
  if (!map) return report(map.error());
  const Result<file::MapPart> part = parse_shard(options.shard, *map);
  if (!part) return report(part.error());
  const std::size_t cells = part->end - part->begin;
  if (!options.output.plot.empty() && cells < map->cell_count()) {
    return report(
        usage_error("--plot: a part has no figure; put the parts together, and "
                    "--read FILE.csv --plot FILE.png draws the whole"));
  }
  catch_stop_signals();
  OutputFile json;
  OutputFile plot;
  if (const Failure failed = json.open(options.output.json)) return report(*failed);
  if (const Failure failed = plot.open(options.output.plot)) return report(*failed);
  if (!options.read.empty()) {
    const Result<std::vector<MapFigures>> figures = file::read_map(options.read, *map);
    if (!figures) return report(figures.error());
    if (file::has_other_sidecar(options.read, *map)) {
      tell(
          fmt::format("note: {} tells of another scene or plan, or of another version of the "
                      "program",
                      file::shown(file::sidecar_path_of(options.read))));
    }
    const Failure failed = write_map(options, *map, *part, *figures, json, plot);
    return failed ? report(*failed) : 0;
  }
  std::optional<file::MapWriter> writer;
  if (!options.output.csv.empty()) {
    Result<file::MapWriter> opened = file::MapWriter::open(options.output.csv, *map, *part);
    if (!opened) return report(opened.error());
    writer = std::move(*opened);
  }
  CellRunner runner(*map, *part, writer);
  {
    Progress progress(fmt::format("map of {}", map->scene.name), !options.output.quiet);
    const Result<bool> whole = runner.run(progress);
    if (!whole) return report(whole.error());
    if (!*whole) return end_early(options, runner.figures().size(), cells);
  }
  if (writer) {
    if (const Failure failed = writer->finish()) return report(*failed);
  }
  const Failure failed = write_map(options, *map, *part, runner.figures(), json, plot);
  return failed ? report(*failed) : 0;
}

int map(const MapOptions& options) {
  if (const Failure failed = check_map_options(options)) return report(*failed);
  Result<Scene> scene = load_map_scene(options);
  if (!scene) return report(scene.error());
  return options.boundary.empty() ? run_map(options, std::move(*scene))
                                  : run_boundary(options, std::move(*scene));
}

}  // namespace

Command add_map(CLI::App& program) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* app = program.add_subcommand(
      "map", "Stability map (Z-width): a scene over a grid of two of its numbers");
  add_headless_options(*app, options->scene);
  const auto add = [&](const char* name, std::string& value, const char* what, const char* type) {
    app->add_option(name, value, what)->type_name(type);
  };
  add("--x", options->x, "A number of the scene and its values, N from LO to HI",
      "KEY=LO:HI:N[:log]");
  add("--y", options->y, "The same of the other axis", "KEY=LO:HI:N[:log]");
  add("--boundary", options->boundary,
      "Instead of a map: where the verdict first changes, by bisection after a scan; with --x, for "
      "each of its values",
      "KEY=LO:HI:N[:log]");
  add("--tolerance", options->tolerance, "Of --boundary, a part of the value; default 0.001", "R");
  add("--shard", options->shard,
      "Only part I of N; the CSVs of all parts, put together, are the map's", "I/N");
  add("--read", options->read,
      "The cells are in this CSV of the whole map; only draw and count them", "FILE");
  add_algorithms_option(*app, options->algorithms);
  add_scene_options(*app, options->scene);
  add_simulator_option(*app, options->scene);
  add("--csv", options->output.csv,
      "A line a cell, and a sidecar; what is there of it when the run is ended, the next goes on "
      "from",
      "FILE");
  add("--plot", options->output.plot, "Draw the map, with the bounds of theory; needs no display",
      "FILE.png");
  add_output_options(*app, options->output);
  app->get_option("--json")->description(
      "Write the counts, or the boundaries, as JSON; - is standard output");
  app->get_option("--expect")->group("");  // not offered, but known
  return {app, [options] { return map(*options); }};
}

}  // namespace hapticwall::command
