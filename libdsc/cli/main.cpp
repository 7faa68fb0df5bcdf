// The program `dsc`: voxels in; surfaces, normals, gradients, heat and distances out.
#include "libdsc/base/error.h"
#include "libdsc/cli/commands/commands.h"
#include "libdsc/cli/file_checks.h"
#include "libdsc/cli/interruption.h"
#include "libdsc/cli/options.h"
#include "libdsc/cli/progress.h"
#include "libdsc/cli/run.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/memory_limit.h"

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>

#include <fmt/format.h>
#include <unistd.h>

namespace dsc::cli {
namespace {

void run_command(Run& run) {
  switch (run.options.command) {
    case Command::info:
      return run_info(run);
    case Command::voxels:
      return run_voxels(run);
    case Command::surface:
      return run_surface(run);
    case Command::normals:
      return run_normals(run);
    case Command::gradient:
      return run_gradient(run);
    case Command::diffuse:
      return run_diffuse(run);
    case Command::geodesic:
      return run_geodesic(run);
    case Command::spectrum:
      return run_spectrum(run);
    case Command::curvature:
      return run_curvature(run);
    case Command::laplacian:
      return run_laplacian(run);
    case Command::poisson:
      return run_poisson(run);
  }
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
    throw OutputError("standard output cannot be written");
  }
}

void run_and_report(const Options& options, ProgressBar& bar) {
  const ProcessMemory memory =
      options.max_memory ? ProcessMemory(*options.max_memory, "by --max-memory") : ProcessMemory();
  Run run{options, {options.threads, &bar, &memory}, {}};
  FileGroup files;
  try {
    {
      const Stopwatch watch(run.report.timings.total);
      run_command(run);
    }
    bar.clear();
    run.report.peak_memory_bytes = peak_memory_bytes();
    if (!options.report.empty()) write_report(options.report, options, run.report);
    run.context.check();
  } catch (const Cancelled&) {
    throw;  // what was there stays
  } catch (...) {
    files.publish();  // the results of a long run are not lost because a later file failed
    throw;
  }
  files.publish();
  if (!options.quiet) {
    const std::string text = summary(run.report);
    if (to_standard_output(options)) {
      std::fputs(text.c_str(), stderr);
    } else {
      print(text);
    }
  }
  for (const std::string& warning : run.report.warnings) {
    std::fprintf(stderr, "dsc: warning: %s\n", warning.c_str());
  }
}

/// What may have made a solver fail.
std::string advice(const Options& o) {
  const double lambda = o.command == Command::curvature ? o.curvature_lambda : o.lambda;
  if (!o.given("--lambda") || (lambda >= 1e-4 && lambda <= 10)) return "";
  return fmt::format("; --lambda {:g} is far from (0, 1], try one of that size", lambda);
}

int run_program(int argc, const char* const* argv) {
  const CommandLine line = parse_command_line(argc, argv);
  if (line.text) {
    print(*line.text);
    return 0;
  }
  const auto bar =
      std::make_shared<ProgressBar>(!line.options.quiet && ::isatty(STDERR_FILENO) != 0);
  watch_signals(bar);
  try {
    run_and_report(line.options, *bar);
  } catch (const SolverError& error) {
    bar->clear();
    throw SolverError(error.what() + advice(line.options));
  } catch (...) {
    bar->clear();
    throw;
  }
  return 0;
}

int fail(int code, const char* message) {
  std::fprintf(stderr, "dsc: %s\n", message);
  return code;
}

}  // namespace
}  // namespace dsc::cli

int main(int argc, char** argv) {
  using namespace dsc;
  try {
    return cli::run_program(argc, argv);
  } catch (const UsageError& error) {
    return cli::fail(2, error.what());
  } catch (const InputError& error) {
    return cli::fail(3, error.what());
  } catch (const OutputError& error) {
    return cli::fail(3, error.what());
  } catch (const LimitError& error) {
    return cli::fail(4, error.what());
  } catch (const std::bad_alloc&) {
    return cli::fail(4, "out of memory; use a coarser grid or a part of the data");
  } catch (const SolverError& error) {
    return cli::fail(5, error.what());
  } catch (const Cancelled&) {
    return cli::fail(cli::kInterruptedExitCode, "interrupted");
  } catch (const std::exception& error) {
    return cli::fail(1, error.what());
  }
}
