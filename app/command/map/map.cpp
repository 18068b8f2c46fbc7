#include "app/command/map/map.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <utility>

#include "app/command/commands.h"
#include "app/command/map/map_axis.h"
#include "app/command/map/map_report.h"
#include "app/command/output_file.h"
#include "app/command/report/progress.h"
#include "app/command/report/terminal.h"
#include "app/command/signals.h"
#include "app/draw/figure/map_figure.h"
#include "app/file/map/map_file.h"
#include "app/file/recording/sidecar.h"
#include "app/file/text/text.h"

namespace hapticwall::command {
namespace {

// Approximate duration of a stretch of cells; each stretch is written at its end.
constexpr double kStretchS = 1.0;
constexpr std::size_t kFirstStretch = 64;
constexpr std::size_t kMaxStretch = 16384;

// "I/N"; the whole map without the option.
Result<file::MapPart> parse_shard(const std::string& text, const StabilityMap& map) {
  if (text.empty()) return file::map_part(map, 1, 1);
  const std::vector<std::string_view> parts = file::split(text, '/');
  const auto index = file::parsed<std::size_t>(parts.front());
  const auto count = file::parsed<std::size_t>(parts.back());
  if (parts.size() == 2 && index && count && *index >= 1 && *index <= *count &&
      *count <= map.cell_count()) {
    return file::map_part(map, *index, *count);
  }
  return usage_error(
      fmt::format("--shard {}: it takes I/N, part I of N, from 1/N to N/N, with N at most the {} "
                  "cells of the map",
                  file::in_quotes(text), map.cell_count()));
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

// Runs the cells of a part that `writer` has not found.
class CellRunner {
 public:
  CellRunner(const StabilityMap& map, const file::MapPart& part,
             std::optional<file::MapWriter>& writer)
      : map_(map), part_(part), writer_(writer) {
    if (writer_) cells_ = writer_->found();
  }

  // False if a signal ended it.
  [[nodiscard]] Result<bool> run(Progress& progress) {
    const std::size_t count = part_.end - part_.begin;
    progress.begin_at(share(cells_.size(), count));
    while (cells_.size() < count) {
      const std::size_t begin = part_.begin + cells_.size();
      const auto start = std::chrono::steady_clock::now();
      const std::vector<MapMetrics> more = run_cells(
          map_, begin, std::min(begin + stretch_, part_.end), [] { return stop_signal() != 0; });
      if (more.empty()) return false;
      if (writer_) {
        if (Failure failed = writer_->append(map_, begin, more)) return *failed;
      }
      cells_.insert(cells_.end(), more.begin(), more.end());
      progress.show(share(cells_.size(), count));
      choose_stretch(std::chrono::steady_clock::now() - start);
    }
    return true;
  }
  [[nodiscard]] const std::vector<MapMetrics>& cells() const { return cells_; }

 private:
  static double share(std::size_t part, std::size_t whole) {
    return static_cast<double>(part) / static_cast<double>(whole);
  }
  void choose_stretch(std::chrono::duration<double> last) {
    if (last.count() < 0.5 * kStretchS) stretch_ = std::min(2 * stretch_, kMaxStretch);
    if (last.count() > 2.0 * kStretchS) stretch_ = std::max(stretch_ / 2, std::size_t{1});
  }

  const StabilityMap& map_;
  const file::MapPart& part_;
  std::optional<file::MapWriter>& writer_;
  std::vector<MapMetrics> cells_;
  std::size_t stretch_ = kFirstStretch;
};

Failure write_map(OutputFiles& files, const StabilityMap& map, const file::MapPart& part,
                  const std::vector<MapMetrics>& cells) {
  return files.write({"", map_json(map, part.begin, cells), map_table(map, part.begin, cells)},
                     [&](const draw::Paper& paper) { return draw::draw_map(map, cells, paper); });
}

// --read: the cells come from a file.
Result<int> show_map(const MapOptions& options, const StabilityMap& map, const file::MapPart& part,
                     OutputFiles& files) {
  const Result<std::vector<MapMetrics>> cells = file::read_map(options.read, map);
  if (!cells) return cells.error();
  if (file::has_other_sidecar(options.read, map)) {
    tell(fmt::format(
        "note: {} describes another scene or plan, or comes from another version of the program",
        file::shown(file::sidecar_path_of(options.read))));
  }
  return status_of(write_map(files, map, part, *cells));
}

int end_early(const std::string& csv, std::size_t done, std::size_t cells) {
  const std::string partial =
      file::shown(csv) + ".partial holds them; repeat the command to resume";
  return ended_early(fmt::format(" after {} of {} cells; {}", done, cells,
                                 csv.empty() ? "nothing was written" : partial));
}

Result<int> compute_map(const MapOptions& options, const StabilityMap& map,
                        const file::MapPart& part, OutputFiles& files) {
  std::optional<file::MapWriter> writer;
  if (!options.output.csv.empty()) {
    Result<file::MapWriter> opened = file::MapWriter::open(options.output.csv, map, part);
    if (!opened) return opened.error();
    writer = std::move(*opened);
  }
  CellRunner runner(map, part, writer);
  {
    Progress progress(fmt::format("map of {}", map.scene.name), !options.output.quiet);
    const Result<bool> whole = runner.run(progress);
    if (!whole) return whole.error();
    if (!*whole) {
      return end_early(options.output.csv, runner.cells().size(), part.end - part.begin);
    }
  }
  if (writer) {
    if (Failure failed = writer->finish()) return *failed;
  }
  return status_of(write_map(files, map, part, runner.cells()));
}

Result<int> run_map(const MapOptions& options, Scene scene) {
  const Result<StabilityMap> map = plan_map(options, std::move(scene));
  if (!map) return map.error();
  const Result<file::MapPart> part = parse_shard(options.shard, *map);
  if (!part) return part.error();
  if (!options.output.plot.empty() && part->end - part->begin < map->cell_count()) {
    return usage_error(
        "--plot: a part of a map has no figure; join the parts, then use --read FILE.csv --plot "
        "FILE.png");
  }
  catch_stop_signals();
  OutputOptions whole_files = options.output;
  whole_files.csv.clear();  // the writer adds to it cell by cell
  Result<OutputFiles> files = OutputFiles::open(whole_files);
  if (!files) return files.error();
  return options.read.empty() ? compute_map(options, *map, *part, *files)
                              : show_map(options, *map, *part, *files);
}

using OptionTexts = std::initializer_list<std::pair<const char*, const std::string*>>;

// The first option that was given, as an error.
Failure refuse(const OptionTexts& given, std::string_view mode) {
  for (const auto& [name, value] : given) {
    if (!value->empty()) return usage_error(fmt::format("{}: not with {}", name, mode));
  }
  return {};
}

// Missing options, and options that exclude each other.
Failure check_options(const MapOptions& options) {
  if (!options.output.expectations.empty()) {
    return usage_error(
        "--expect: 'map' has no single summary; use 'hapticwall run SCENE --expect EXPR'");
  }
  if (Failure failed = check_outputs(
          options.output,
          {options.scene.scene, sidecar_read_with(options.scene.scene), options.read})) {
    return failed;
  }
  if (options.boundary.empty()) {
    if (options.x.empty() || options.y.empty()) {
      return usage_error(
          "map: it takes --x and --y, each KEY=LO:HI:N or KEY=LO:HI:N:log; or --boundary");
    }
    if (!options.tolerance.empty()) return usage_error("--tolerance: it needs --boundary");
    if (!options.read.empty() && !options.output.csv.empty()) {
      return usage_error("--read: not with --csv, because the file has the cells already");
    }
    if (!options.read.empty() && !options.shard.empty()) {
      return usage_error("--read: not with --shard, because it takes the whole map");
    }
    return {};
  }
  return refuse({{"--y", &options.y},
                 {"--shard", &options.shard},
                 {"--read", &options.read},
                 {"--plot", &options.output.plot}},
                "--boundary");
}

Result<int> map(const MapOptions& options) {
  if (Failure failed = check_options(options)) return *failed;
  Result<file::LoadedScene> loaded = load_for_study("map", options.scene, options.output.quiet);
  if (!loaded) return loaded.error();
  if (Failure failed = check_scene_files(options.output, *loaded)) return *failed;
  return options.boundary.empty() ? run_map(options, std::move(loaded->scene))
                                  : run_boundary(options, std::move(loaded->scene));
}

}  // namespace

Failure invalid_cell(const std::optional<SceneProblem>& problem) {
  if (!problem) return {};
  return usage_error(fmt::format("a value of the map: {}: {}", problem->key, problem->message));
}

Command add_map(CLI::App& program) {
  const auto options = std::make_shared<MapOptions>();
  CLI::App* app = program.add_subcommand(
      "map", "Compute the stability map of this hand: a scene over a grid of two of its numbers");
  add_headless_options(*app, options->scene);
  const auto add = [&](const char* name, std::string& value, const char* what, const char* type) {
    app->add_option(name, value, what)->type_name(type);
  };
  add("--x", options->x, "A number of the scene and its N values from LO to HI",
      "KEY=LO:HI:N[:log]");
  add("--y", options->y, "The same for the other axis", "KEY=LO:HI:N[:log]");
  add("--boundary", options->boundary,
      "Instead of a map, find the first change of the verdict, by a scan and bisection; with --x, "
      "for "
      "each of its values",
      "KEY=LO:HI:N[:log]");
  add("--tolerance", options->tolerance, "Relative tolerance of --boundary; default 0.001", "R");
  add("--shard", options->shard,
      "Compute part I of N only; the joined CSVs of all parts are the map's", "I/N");
  add("--read", options->read,
      "Draw and count the cells of this CSV of the whole map, without computing", "FILE");
  add_algorithms_option(*app, options->algorithms);
  add_scene_options(*app, options->scene);
  add_simulator_option(*app, options->scene);
  add_csv_option(*app, options->output,
                 "Write one line per cell, and a sidecar; repeat the command to resume an "
                 "interrupted map");
  add_plot_option(*app, options->output, "Draw the map with the bounds of theory");
  add_output_options(*app, options->output);
  app->get_option("--json")->description(
      "Write the counts or the boundaries as JSON; - is standard output");
  app->get_option("--expect")->group("");  // hidden
  return {app, [options] { return map(*options); }};
}

}  // namespace hapticwall::command
