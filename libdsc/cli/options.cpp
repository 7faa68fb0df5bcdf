#include "libdsc/cli/options.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/completion.h"
#include "libdsc/cli/help.h"
#include "libdsc/cli/option_checks.h"
#include "libdsc/cli/option_groups.h"
#include "libdsc/cli/option_kinds.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <limits>
#include <string>

namespace dsc::cli {
namespace {

CLI::App& add_command(CLI::App& app, Options& o, Command command, const char* description) {
  CLI::App& sub = *app.add_subcommand(name_of(command), description);
  sub.footer(help_footer(command));
  sub.callback([&o, command] { o.command = command; });
  add_input(sub, o, command != Command::voxels);
  return sub;
}

void add_curvature(CLI::App& curvature, Options& o) {
  add_choice(curvature, "--estimator", o.curvature,
             {{"ii", CurvatureEstimator::integral_invariant},
              {"laplacian", CurvatureEstimator::laplacian}},
             "integral invariants: mean, Gaussian and principal curvatures per face; or the "
             "Laplacian of the positions: mean curvature per vertex (default: ii; laplacian for "
             "labels)");
  add_positive(curvature, "--radius", o.radius,
               "radius of the ball of ii, or of the ball of the normals, in world units (default: "
               "3 h^(1/2) for a shape; 8 voxels for data, 6 for normals)");
  add_choice(curvature, "--form", o.form,
             {{"centred", CurvatureForm::centred}, {"plain", CurvatureForm::plain}},
             "ii: the form in which the offset of the surfels from the surface cancels, or the "
             "plain one, which has no bias on spheres and scatters more (default: centred)");
  add_choice(curvature, "--on", o.on_vertices, {{"face", false}, {"vertex", true}},
             "ii: a value a face, or their averages at the vertices (default: face)");
  add_positive(curvature, "--diffuse", o.time,
               "laplacian: diffuse the result for this time, world units squared (default: not at "
               "all)")
      ->type_name("T");
  add_positive(curvature, "--lambda", o.curvature_lambda,
               "laplacian: weight of the stabilisation (default: none, since it biases curvature)");
  name_group(curvature, "Curvature");
  add_run(curvature, o, Writes::results);
}

void add_commands(CLI::App& app, Options& o) {
  CLI::App& info = add_command(app, o, Command::info, "count what a digital surface is made of");
  add_run(info, o, Writes::nothing);

  CLI::App& voxels = add_command(app, o, Command::voxels,
                                 "write the voxels that are inside, or their labels, as a volume");
  add_run(voxels, o, Writes::volumes);
  voxels.get_option("--output")->required();

  CLI::App& surface = add_command(app, o, Command::surface, "extract the surface");
  surface.add_flag("--regularise", o.regularise,
                   "move the vertices so that faces stand across the estimated normals: a smooth "
                   "mesh with the same faces");
  name_group(surface, "Surface");
  add_normals(surface, o);
  add_run(surface, o, Writes::results);
  surface.get_option("--output")->required();

  CLI::App& normals = add_command(app, o, Command::normals, "estimate a normal for every surfel");
  add_normals(normals, o);
  add_run(normals, o, Writes::results);

  CLI::App& gradient =
      add_command(app, o, Command::gradient, "take the gradient of a function along the surface");
  gradient.add_option("--function", o.function, "an expression in x, y and z")
      ->type_name("EXPR")
      ->required();
  name_group(gradient, "Function");
  add_calculus(gradient, o, false);
  add_compare(gradient, o);
  add_run(gradient, o, Writes::results);

  CLI::App& diffuse = add_command(app, o, Command::diffuse, "let heat spread from sources");
  add_sources(diffuse, o);
  add_positive(diffuse, "--time", o.time, "time of the one implicit step, world units squared")
      ->required();
  name_group(diffuse, "Heat");
  add_calculus(diffuse, o, true);
  add_compare(diffuse, o);
  add_run(diffuse, o, Writes::results);

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
  add_calculus(geodesic, o, true);
  add_compare(geodesic, o);
  add_run(geodesic, o, Writes::results);

  CLI::App& spectrum = add_command(app, o, Command::spectrum,
                                   "find the lowest frequencies of the surface and their shapes");
  spectrum.add_option("-k,--count", o.count, "eigenvalues wanted, the lowest ones (default: 10)")
      ->type_name("N")
      ->check(CLI::Range(1, 100000).description(""));
  name_group(spectrum, "Spectrum");
  add_calculus(spectrum, o, true);
  add_run(spectrum, o, Writes::results);

  add_curvature(add_command(app, o, Command::curvature, "estimate how the surface bends"), o);

  CLI::App& laplacian =
      add_command(app, o, Command::laplacian, "apply the Laplace-Beltrami operator to a function");
  laplacian.add_option("--function", o.function, "an expression in x, y and z")
      ->type_name("EXPR")
      ->required();
  add_positive(laplacian, "--diffuse", o.time,
               "diffuse the result for this time, world units squared: about 0.035 h on a shape of "
               "unit size (default: not at all)")
      ->type_name("T");
  name_group(laplacian, "Function");
  add_calculus(laplacian, o, true);
  add_compare(laplacian, o);
  add_run(laplacian, o, Writes::results);

  CLI::App& poisson =
      add_command(app, o, Command::poisson, "solve Poisson's equation, Laplacian of u = EXPR");
  poisson.add_option("--rhs", o.rhs, "the Laplacian of u: an expression in x, y and z")
      ->type_name("EXPR")
      ->required();
  poisson
      .add_option("--fix", o.fix,
                  "the values of u on the boundary of the surface (default: its derivative across "
                  "the boundary is 0)")
      ->type_name("EXPR");
  name_group(poisson, "Equation");
  add_calculus(poisson, o, true);
  add_compare(poisson, o);
  add_run(poisson, o, Writes::results);
}

void check_input(const Options& o) {
  if (o.given("INPUT") && o.given("--input")) {
    throw UsageError("INPUT and --input both say what is read; give one of them");
  }
  if (o.input.empty()) {
    throw UsageError(std::string("INPUT is required; see dsc ") + name_of(o.command) + " --help");
  }
}

/// -m and -M, which leave their lower end out, as the closed interval of --threshold.
void set_threshold(Options& o) {
  if (!o.above && !o.up_to) return;
  if (o.threshold) {
    throw UsageError("--threshold and -m, -M both say which values are inside; give one of them");
  }
  constexpr double kNone = std::numeric_limits<double>::infinity();
  o.threshold = {std::nextafter(o.above.value_or(0.), kNone), o.up_to.value_or(kNone)};
  if ((*o.threshold)[0] > (*o.threshold)[1]) {
    throw UsageError(fmt::format("-m {:g} -M {:g}: no value is above the one and up to the other",
                                 o.above.value_or(0.), (*o.threshold)[1]));
  }
}

/// A text that is made of the description of the command line itself.
std::optional<std::string> described(const CLI::App& app, int argc, const char* const* argv) {
  const std::string asked = argc > 1 ? argv[1] : "";
  if (asked == "--manual" && argc == 2) return manual_page(app);
  if (asked != "--completion") return std::nullopt;
  const std::string shell = argc == 3 ? argv[2] : "";
  if (shell == "bash") return bash_completion(app);
  if (shell == "zsh") return zsh_completion(app);
  throw UsageError("--completion " + shell + ": expected bash|zsh");
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
  app.add_option("--completion", "print what completes command lines of dsc in this shell")
      ->type_name("bash|zsh");
  app.add_flag_function(
      "--manual", [](std::int64_t) {}, "print the manual page, for man -l -");
  app.require_subcommand(1);
  app.footer(help_footer());
  add_commands(app, line.options);
  line.text = described(app, argc, argv);
  if (line.text) return line;
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
  for (const CLI::Option* option : app.get_subcommands().front()->get_options()) {
    if (option->count() > 0) line.options.typed.insert(option->get_name());
  }
  check_input(line.options);
  set_threshold(line.options);
  check_options(line.options);
  return line;
}

const char* name_of(Command command) {
  switch (command) {
    case Command::info:
      return "info";
    case Command::voxels:
      return "voxels";
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
    case Command::curvature:
      return "curvature";
    case Command::laplacian:
      return "laplacian";
    case Command::poisson:
      return "poisson";
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

const char* name_of(Stabilization stabilisation) {
  switch (stabilisation) {
    case Stabilization::de_goes:
      return "de-goes";
    case Stabilization::mercat:
      return "mercat";
    case Stabilization::corrected_elements:
      return "elements";
    case Stabilization::virtual_refinement:
      return "refinement";
  }
  return "";
}

}  // namespace dsc::cli
