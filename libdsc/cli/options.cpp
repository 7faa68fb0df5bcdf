#include "libdsc/cli/options.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/help.h"
#include "libdsc/cli/option_checks.h"
#include "libdsc/cli/option_groups.h"
#include "libdsc/cli/option_kinds.h"

#include <CLI/CLI.hpp>

#include <string>

namespace dsc::cli {
namespace {

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
  check_options(line.options);
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
