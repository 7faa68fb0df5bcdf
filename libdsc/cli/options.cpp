#include "libdsc/cli/options.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/help.h"
#include "libdsc/cli/numbers.h"
#include "libdsc/cli/option_kinds.h"
#include "libdsc/io/results.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>

namespace dsc::cli {
namespace {

/// What only raw files need. A layout without a size was asked for without --size.
void add_raw(CLI::App& app, Options& o) {
  const auto layout = [&o]() -> RawLayout& { return o.raw ? *o.raw : o.raw.emplace(); };
  app.add_option_function<std::string>(
         "--size",
         [layout](const std::string& text) { layout().size = parse_size(text, "--size"); },
         "voxels along x, y and z: INPUT is raw, x fastest, then y")
      ->type_name("X,Y,Z");
  app.add_option_function<std::string>(
         "--type",
         [&o, layout](const std::string& text) {
           layout().type = value_type(text);
           o.raw_type = true;
         },
         "the type of its values, little-endian")
      ->type_name("u8|i8|u16|i16|u32|i32|u64|i64|f32|f64");
  app.add_option_function<std::string>(
         "--endian",
         [layout](const std::string& text) {
           if (text != "little" && text != "big") {
             throw UsageError("--endian " + text + ": expected little|big");
           }
           layout().big_endian = text == "big";
         },
         "its byte order (default: little)")
      ->type_name("little|big");
  app.add_option_function<std::int64_t>(
         "--offset", [layout](std::int64_t bytes) { layout().offset = bytes; },
         "bytes before its first value (default: 0)")
      ->type_name("BYTES")
      ->check(CLI::NonNegativeNumber.description(""));
  name_group(app, "Raw files");
}

void add_input(CLI::App& app, Options& o) {
  app.add_option("INPUT", o.input,
                 "a volume file (" + volume_endings() + ", or raw) or shape:NAME[,key=value...]")
      ->required()
      ->type_name("");
  app.add_option_function<std::string>(
         "--gridstep",
         [&o](const std::string& text) { o.gridstep = parse_spacing(text, "--gridstep"); },
         "edge of a voxel in world units, one number or hx,hy,hz; required for a shape, 1 for a "
         "file unless it says otherwise")
      ->type_name("H");
  app.add_option_function<std::string>(
         "--threshold",
         [&o](const std::string& text) {
           const std::vector<double> n = parse_numbers(text, "--threshold");
           if (n.size() != 2 || n[0] > n[1]) {
             throw UsageError("--threshold " + text + ": expected LO,HI with LO <= HI");
           }
           o.threshold = {n[0], n[1]};
         },
         "voxels with LO <= value <= HI are inside (default: every nonzero voxel)")
      ->type_name("LO,HI");
  app.add_option("--label", o.labels, "voxels with this value are inside; again for more")
      ->type_name("N")
      ->allow_extra_args(false);
  add_choice(app, "--labels", o.all_labels, {{"all", true}},
             "every value is a label, 0 the outside: extract every interface between two labels");
  app.add_option_function<std::vector<std::string>>(
         "--between",
         [&o](const std::vector<std::string>& all) {
           for (const std::string& text : all) o.between.push_back(parse_labels(text, "--between"));
         },
         "of all labels' interfaces only that between A and B, 0 being the outside; again for more")
      ->type_name("A,B")
      ->allow_extra_args(false);
  add_choice(app, "--adjacency", o.adjacency,
             {{"interior", Adjacency::interior}, {"exterior", Adjacency::exterior}},
             "which surfels are linked where four meet at an edge (default: interior)");
  add_choice(
      app, "--border", o.border, {{"closed", Border::closed}, {"open", Border::open}},
      "what happens where the object touches the border of the volume (default: closed; open "
      "for a shape that its box cuts)");
  name_group(app, "Input");
  add_raw(app, o);
}

void add_run(CLI::App& app, Options& o, bool writes) {
  if (writes) {
    app.add_option("-o,--output", o.outputs,
                   "write the result here; again for more (" + result_endings() + ")")
        ->type_name("FILE")
        ->allow_extra_args(false);
  }
  app.add_option("--report", o.report, "write counts, timings, memory and errors here as JSON")
      ->type_name("FILE");
  app.add_option("--threads", o.threads, "threads to use (default: one per core)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024).description(""));
  app.add_flag("--quiet", o.quiet, "no progress bar and no summary");
  name_group(app, "Run");
}

void add_normals(CLI::App& app, Options& o) {
  add_choice(app, "--estimator", o.estimator,
             {{"ii", Estimator::integral_invariant},
              {"trivial", Estimator::trivial},
              {"analytic", Estimator::analytic}},
             "how normals are estimated (default: ii, the integral invariant)");
  add_positive(app, "--radius", o.radius,
               "radius of the ball of ii, in world units (default: 3 h^(1/2) for a shape, a few "
               "voxels for data)");
  add_choice(app, "--centre", o.centre,
             {{"surfel", BallCentre::surfel}, {"pair", BallCentre::voxel_pair}},
             "where the ball of ii is centred: on the surfel, or on both of its voxels in turn "
             "(default: surfel)");
  name_group(app, "Normals");
}

void add_calculus(CLI::App& app, Options& o) {
  add_normals(app, o);
  add_choice(app, "--calculus", o.projected, {{"projected", true}, {"naive", false}},
             "operators on faces projected along the estimated normals, or on the surfels as they "
             "are (default: projected)");
  add_positive(app, "--lambda", o.lambda, "weight of the stabilisation (default: 0.25)");
  name_group(app, "Calculus");
}

void add_sources(CLI::App& app, Options& o) {
  app.add_option_function<std::vector<std::string>>(
         "--source",
         [&o](const std::vector<std::string>& all) {
           for (const std::string& text : all) o.sources.push_back(parse_point(text, "--source"));
         },
         "a point in world units; the vertex nearest to it is a source; again for more")
      ->type_name("X,Y,Z")
      ->allow_extra_args(false);
  app.add_option("--source-vertex", o.source_vertices, "a vertex id as a source; again for more")
      ->type_name("ID")
      ->allow_extra_args(false);
}

CLI::App& add_command(CLI::App& app, Options& o, Command command, const char* description) {
  CLI::App& sub = *app.add_subcommand(name_of(command), description);
  sub.footer(help_footer(command));
  sub.callback([&o, command] { o.command = command; });
  add_input(sub, o);
  return sub;
}

void add_commands(CLI::App& app, Options& o) {
  CLI::App& info = add_command(app, o, Command::info, "count what a digital surface is made of");
  add_run(info, o, false);

  CLI::App& surface = add_command(app, o, Command::surface, "extract the surface");
  add_run(surface, o, true);
  surface.get_option("--output")->required();

  CLI::App& normals = add_command(app, o, Command::normals, "estimate a normal for every surfel");
  add_normals(normals, o);
  add_run(normals, o, true);

  CLI::App& gradient =
      add_command(app, o, Command::gradient, "take the gradient of a function along the surface");
  gradient.add_option("--function", o.function, "an expression in x, y and z")
      ->type_name("EXPR")
      ->required();
  name_group(gradient, "Function");
  add_calculus(gradient, o);
  add_run(gradient, o, true);

  CLI::App& diffuse = add_command(app, o, Command::diffuse, "let heat spread from sources");
  add_sources(diffuse, o);
  add_positive(diffuse, "--time", o.time, "time of the one implicit step, world units squared")
      ->required();
  name_group(diffuse, "Heat");
  add_calculus(diffuse, o);
  add_run(diffuse, o, true);

  CLI::App& geodesic =
      add_command(app, o, Command::geodesic, "measure distances along the surface");
  add_sources(geodesic, o);
  add_choice(geodesic, "--boundary", o.boundary,
             {{"mixed", BoundaryChoice::mixed}, {"neumann", BoundaryChoice::neumann}},
             "where the surface has a boundary: Neumann conditions, or the mean of Neumann and "
             "Dirichlet (default: mixed)");
  add_positive(geodesic, "--time", o.time,
               "time of the heat step, world units squared (default: the largest spacing squared)");
  add_choice(geodesic, "--method", o.method,
             {{"auto", DistanceMethod::automatic},
              {"direct", DistanceMethod::direct},
              {"bands", DistanceMethod::bands}},
             "how heat is solved for: at once, or band after band along its front (default: auto)");
  name_group(geodesic, "Distance");
  add_calculus(geodesic, o);
  add_run(geodesic, o, true);

  CLI::App& spectrum = add_command(app, o, Command::spectrum,
                                   "find the lowest frequencies of the surface and their shapes");
  spectrum.add_option("-k,--count", o.count, "eigenvalues wanted, the lowest ones (default: 10)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  name_group(spectrum, "Spectrum");
  add_calculus(spectrum, o);
  add_run(spectrum, o, true);
}

/// CLI11 would only say that a subcommand is missing.
void check_command(const CLI::App& app, int argc, const char* const* argv) {
  if (argc < 2 || argv[1][0] == '-') return;
  std::string known;
  for (const CLI::App* sub : app.get_subcommands({})) {
    if (sub->get_name() == argv[1]) return;
    known += (known.empty() ? "" : ", ") + sub->get_name();
  }
  throw UsageError("'" + std::string(argv[1]) + "' is no command; there are " + known +
                   "; see dsc --help");
}

/// A mistyped folder should not come out after the work is done. \throws OutputError.
void check_folder(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (!folder.empty() && !std::filesystem::is_directory(folder)) {
    throw OutputError("'" + path + "': the folder '" + folder.string() +
                      "' does not exist; create it first");
  }
}

/// What CLI11 cannot know.
void check(const Options& o) {
  const bool shape = o.input.rfind("shape:", 0) == 0;
  if (shape && !o.gridstep) {
    throw UsageError("'" + o.input + "' needs --gridstep H, the edge of a voxel");
  }
  if (shape && (o.threshold || !o.labels.empty() || o.labelled())) {
    throw UsageError(
        "--threshold, --label, --labels and --between choose voxels of a volume file; a shape has "
        "none");
  }
  if (o.labelled() && (o.threshold || !o.labels.empty())) {
    throw UsageError(
        "--threshold and --label make one object of the voxels, --labels and --between keep their "
        "labels apart; give one of them");
  }
  if (o.all_labels && !o.between.empty()) {
    throw UsageError("--labels all has every interface, --between one of them; give one of them");
  }
  if (o.labelled() && o.centre == BallCentre::voxel_pair) {
    throw UsageError("--centre pair is not there for labels: their ball is centred on the surfel");
  }
  if (shape && o.raw) throw UsageError("--size and --type describe a raw file, not a shape");
  if (o.raw && (o.raw->size[0] == 0 || !o.raw_type)) {
    throw UsageError("a raw file needs --size X,Y,Z and --type u8 or another");
  }
  if (!shape && !o.raw && std::filesystem::path(o.input).extension() == ".raw") {
    throw UsageError("'" + o.input + "': a raw file needs --size X,Y,Z and --type u8 or another");
  }
  if (!shape && o.estimator == Estimator::analytic) {
    throw UsageError("--estimator analytic needs a shape: voxels have no exact normals");
  }
  const bool wants_sources = o.command == Command::diffuse || o.command == Command::geodesic;
  if (wants_sources && o.sources.empty() && o.source_vertices.empty()) {
    throw UsageError(std::string(name_of(o.command)) +
                     " needs a source: --source x,y,z or --source-vertex ID");
  }
  if (o.threshold && !o.labels.empty()) {
    throw UsageError("--threshold and --label both say which voxels are inside; give one of them");
  }
  std::vector<std::string> files = o.outputs;
  if (!o.report.empty()) files.push_back(o.report);
  std::sort(files.begin(), files.end());
  const auto twice = std::adjacent_find(files.begin(), files.end());
  if (twice != files.end()) throw UsageError("'" + *twice + "' is to be written twice");
  for (const std::string& path : o.outputs) check_result_path(path);
  check_folder(o.report);
}

}  // namespace

CommandLine parse_command_line(int argc, const char* const* argv) {
  CommandLine line;
  CLI::App app{"Discrete differential calculus on digital surfaces: the boundaries of voxel sets.",
               "dsc"};
  app.set_version_flag("--version", std::string("dsc ") + DSC_VERSION);
  app.require_subcommand(1);
  app.footer(help_footer());
  add_commands(app, line.options);
  check_command(app, argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    line.text = wrapped(chosen.empty() ? app.help() : chosen.front()->help("dsc"));
    return line;
  } catch (const CLI::CallForVersion&) {
    line.text = std::string("dsc ") + DSC_VERSION + "\n";
    return line;
  } catch (const CLI::ParseError& error) {
    const auto chosen = app.get_subcommands();
    const std::string help =
        chosen.empty() ? "dsc --help" : "dsc " + chosen.front()->get_name() + " --help";
    throw UsageError(std::string(error.what()) + "; see " + help);
  }
  check(line.options);
  return line;
}

const char* name_of(Command command) {
  switch (command) {
    case Command::info:
      return "info";
    case Command::surface:
      return "surface";
    case Command::normals:
      return "normals";
    case Command::gradient:
      return "gradient";
    case Command::diffuse:
      return "diffuse";
    case Command::geodesic:
      return "geodesic";
    case Command::spectrum:
      return "spectrum";
  }
  return "";
}

const char* name_of(Estimator estimator) {
  switch (estimator) {
    case Estimator::integral_invariant:
      return "ii";
    case Estimator::trivial:
      return "trivial";
    case Estimator::analytic:
      return "analytic";
  }
  return "";
}

}  // namespace dsc::cli
