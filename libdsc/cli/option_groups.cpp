#include "libdsc/cli/option_groups.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/numbers.h"
#include "libdsc/cli/option_kinds.h"
#include "libdsc/cli/picture_options.h"
#include "libdsc/io/mesh_reader.h"
#include "libdsc/io/results.h"
#include "libdsc/io/volume_writer.h"

#include <string>

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

/// Which of the voxels' faces make the surface, and how they are linked.
void add_extraction(CLI::App& app, Options& o) {
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
}

}  // namespace

void add_input(CLI::App& app, Options& o, bool extracts) {
  const std::string meshes = extracts ? ", a mesh file (" + mesh_endings() + ")" : "";
  app.add_option("INPUT", o.input,
                 "a volume file (" + volume_endings() + ", or raw)" + meshes +
                     " or shape:NAME[,key=value...]")
      ->type_name("");
  app.add_option("-i,--input", o.input, "INPUT by an option")->type_name("FILE");
  app.add_option_function<std::string>(
         "-g,--gridstep",
         [&o](const std::string& text) { o.gridstep = parse_spacing(text, "--gridstep"); },
         "edge of a voxel in world units, one number or hx,hy,hz; required for a shape, 1 for a "
         "file unless it says otherwise")
      ->type_name("H");
  app.add_option_function<std::string>(
         "--grid", [&o](const std::string& name) { o.grid = name; },
         "the grid of a .vdb file by its name (default: the only one that has numbers)")
      ->type_name("NAME");
  app.add_option_function<std::string>(
         "--threshold",
         [&o](const std::string& text) {
           const std::vector<double> n = parse_numbers(text, "--threshold");
           if (n.size() != 2 || n[0] > n[1]) {
             throw UsageError("--threshold " + text + ": expected LO,HI with LO <= HI");
           }
           o.threshold = {n[0], n[1]};
         },
         "voxels with LO <= value <= HI are inside (default: every nonzero voxel; in .vdb, of "
         "a level set those with value < 0, of a fog volume those with value > 0)")
      ->type_name("LO,HI");
  add_number(app, "-m,--thresholdMin", o.above,
             "the same by two options: voxels with LO < value (default with -M: 0)");
  add_number(app, "-M,--thresholdMax", o.up_to, "and value <= HI (default with -m: no limit)");
  app.add_option("--label", o.labels, "voxels with this value are inside; again for more")
      ->type_name("N")
      ->allow_extra_args(false);
  add_choice(app, "--labels", o.all_labels, {{"all", true}},
             extracts
                 ? "every value is a label, 0 the outside: extract every interface between two "
                   "labels"
                 : "every value is a label, 0 the outside: write the labels (default: 1 for a "
                   "voxel inside, 0 outside)");
  if (extracts) add_extraction(app, o);
  name_group(app, "Input");
  add_raw(app, o);
}

void add_run(CLI::App& app, Options& o, Writes writes) {
  if (writes != Writes::nothing) {
    const bool volumes = writes == Writes::volumes;
    app.add_option("-o,--output", o.outputs,
                   volumes
                       ? "write the voxels here; again for more (" + written_volume_endings() + ")"
                       : "write the result here; again for more (" + result_endings() +
                             ", .glb: for viewers, .png: a picture, .html: a page)")
        ->type_name("FILE")
        ->allow_extra_args(false);
    name_group(app, "Run");
    if (!volumes) add_picture(app, o);
  }
  app.add_option("--report", o.report, "write counts, timings, memory and errors here as JSON")
      ->type_name("FILE");
  app.add_option("--threads", o.threads, "threads to use (default: one per core)")
      ->type_name("N")
      ->check(CLI::Range(1, 1024).description(""));
  app.add_option_function<std::string>(
         "--max-memory",
         [&o](const std::string& text) { o.max_memory = parse_bytes(text, "--max-memory"); },
         "bytes of memory to use at most, with K, M or G for powers of 1024: a stage that would "
         "need more is refused before it begins, with exit code 4 (default: what the machine, or "
         "the container, has available)")
      ->type_name("SIZE");
  app.add_flag("--quiet", o.quiet, "no progress bar and no summary");
  name_group(app, "Run");
}

void add_normals(CLI::App& app, Options& o) {
  add_choice(
      app, "--estimator", o.estimator,
      {{"ii", Estimator::integral_invariant},
       {"trivial", Estimator::trivial},
       {"analytic", Estimator::analytic}},
      "how normals are estimated (default: ii, the integral invariant; trivial for a mesh: the "
      "faces' own)")
      ->each([&o](const std::string&) { o.estimator_given = true; });
  add_positive(app, "--radius", o.radius,
               "radius of the ball of ii, in world units (default: 3 h^(1/2) for a shape, a few "
               "voxels for data)");
  add_choice(app, "--centre", o.centre,
             {{"surfel", BallCentre::surfel}, {"pair", BallCentre::voxel_pair}},
             "where the ball of ii is centred: on the surfel, or on both of its voxels in turn "
             "(default: surfel)");
  name_group(app, "Normals");
}

void add_calculus(CLI::App& app, Options& o, bool laplacian) {
  add_normals(app, o);
  add_choice(app, "--calculus", o.projected, {{"projected", true}, {"naive", false}},
             "operators on faces projected along the estimated normals, or on the surfels as they "
             "are (default: projected; for a mesh naive, unless its file has normals)")
      ->each([&o](const std::string&) { o.calculus_given = true; });
  if (laplacian) {
    add_choice(
        app, "--stabilisation", o.stabilisation,
        {{"de-goes", Stabilization::de_goes},
         {"mercat", Stabilization::mercat},
         {"elements", Stabilization::corrected_elements},
         {"refinement", Stabilization::virtual_refinement}},
        "what weighs the part of a 1-form that no tangent vector explains: the number of "
        "--lambda; nothing, and checkerboards are taken out of the results; or what bilinear "
        "finite elements or triangles around a virtual centre weigh it with, on voxels only "
        "(default: de-goes)");
    add_positive(app, "--lambda", o.lambda,
                 "weight of the stabilisation de-goes, best in (0, 1] (default: 0.25)");
  }
  name_group(app, "Calculus");
}

void add_compare(CLI::App& app, Options& o) {
  add_choice(app, "--compare", o.compare_naive, {{"naive", true}},
             "compute the result by the naive calculus too; its field is called NAME_naive, and a "
             "page shows both");
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

}  // namespace dsc::cli
