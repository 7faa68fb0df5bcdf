#include "libdsc/cli/picture_options.h"

#include "libdsc/base/error.h"
#include "libdsc/cli/input.h"
#include "libdsc/cli/numbers.h"
#include "libdsc/cli/option_kinds.h"
#include "libdsc/io/path_extension.h"

#include <algorithm>
#include <cmath>

namespace dsc::cli {
namespace {

#ifdef DSC_WITH_PICTURES
constexpr bool kPictures = true;
#else
constexpr bool kPictures = false;
#endif

constexpr const char* kOptions[] = {"--view",     "--up",      "--picture-size",
                                    "--field",    "--range",   "--colormap",
                                    "--isolines", "--shading", "--glyphs"};

/// What the command's own result is, where no field of it is chosen by name.
enum class Shown { nothing, vertex_scalar, face_scalar, directions, vectors };

Shown shown_by(const Options& o) {
  switch (o.command) {
    case Command::info:
    case Command::voxels:
    case Command::surface:
      return Shown::nothing;
    case Command::normals:
      return Shown::directions;
    case Command::gradient:
      return Shown::vectors;
    case Command::curvature:
      return curvature_estimator(o) == CurvatureEstimator::integral_invariant && !o.on_vertices
                 ? Shown::face_scalar
                 : Shown::vertex_scalar;
    default:
      return Shown::vertex_scalar;
  }
}

/// An option that the field shown gives nothing to do.
void check_have_effect(const Options& o) {
  if (!o.picture_field.empty()) return;  // its kind is known when there is a result
  const Shown shown = shown_by(o);
  const auto refuse = [&](const char* option, const std::string& why) {
    if (!o.given(option)) return;
    throw UsageError(std::string(option) + " has no effect on the picture of dsc " +
                     name_of(o.command) + ": " + why + "; leave it out");
  };
  if (shown == Shown::nothing || shown == Shown::directions) {
    const char* why = shown == Shown::nothing ? "no scalar is shown"
                                              : "unit vectors are shown by their directions";
    refuse("--range", why);
    refuse("--colormap", why);
  }
  if (shown != Shown::vertex_scalar) {
    refuse("--isolines", "isolines run between values at vertices, which it does not have");
  }
  if (shown != Shown::directions && shown != Shown::vectors) {
    refuse("--glyphs", "arrows show vectors, which it does not have");
  }
}

void read_count(const std::string& text, const char* option, int most, int& target) {
  const std::vector<double> n = parse_numbers(text, option);
  if (n.size() != 1 || n[0] != std::floor(n[0]) || n[0] < 0 || n[0] > most) {
    throw UsageError(std::string(option) + " " + text + ": expected a whole number from 0 to " +
                     std::to_string(most));
  }
  target = static_cast<int>(n[0]);
}

}  // namespace

bool is_picture_path(const std::string& path) { return extension_of(path) == ".png"; }

void add_picture(CLI::App& app, Options& o) {
  using Text = const std::string&;
  app.add_option_function<std::string>(
         "--view",
         [&o](Text text) {
           const std::string up = o.picture.view.up;
           o.picture.view = render::View::of(text, up);
         },
         "from where the surface is seen: front (from -y), back, left, right, top, bottom, iso, or "
         "azimuth and elevation in degrees (default: 30,20)")
      ->type_name("NAME|AZ,EL");
  add_choice(app, "--up", o.picture.view.up,
             {{"z", "z"}, {"y", "y"}, {"x", "x"}, {"-z", "-z"}, {"-y", "-y"}, {"-x", "-x"}},
             "the axis that points up; the names of views turn with it (default: z)");
  app.add_option_function<std::string>(
         "--picture-size",
         [&o](Text text) {
           const std::vector<double> n = parse_numbers(text, "--picture-size");
           const auto bad = [](double x) { return x != std::floor(x) || x < 16 || x > 16384; };
           if (n.size() != 2 || bad(n[0]) || bad(n[1])) {
             throw UsageError("--picture-size " + text + ": expected W,H, each 16 to 16384 pixels");
           }
           o.picture.width = static_cast<int>(n[0]);
           o.picture.height = static_cast<int>(n[1]);
         },
         "pixels; --size is about raw files (default: 1600,1200)")
      ->type_name("W,H");
  app.add_option("--field", o.picture_field, "the field that is shown (default: the first one)")
      ->type_name("NAME");
  app.add_option_function<std::string>(
         "--range",
         [&o](Text text) {
           const std::vector<double> n = parse_numbers(text, "--range");
           if (n.size() != 2 || !(n[0] < n[1])) {
             throw UsageError("--range " + text + ": expected LO,HI with LO < HI");
           }
           o.picture.range = {n[0], n[1]};
         },
         "the values at the ends of the colour bar; an end beyond which there are more is pointed "
         "(default: the least and the largest)")
      ->type_name("LO,HI");
  add_choice(app, "--colormap", o.picture.colormap,
             {{"lagoon", "lagoon"}, {"ember", "ember"}, {"grey", "grey"}, {"polar", "polar"}},
             "perceptually uniform colours; polar has 0 in its middle (default: lagoon, polar for "
             "values of both signs)");
  app.add_option_function<std::string>(
         "--isolines",
         [&o](Text text) { read_count(text, "--isolines", 1000, o.picture.isolines); },
         "lines at round values, at most N + 1 of them; 0: none (default: 12)")
      ->type_name("N");
  add_choice(app, "--shading", o.picture.shading,
             {{"true", render::Shading::true_normals}, {"flat", render::Shading::flat}},
             "light falls on the estimated normals, or on the faces as they are (default: true "
             "where normals are estimated)");
  app.add_option_function<std::string>(
         "--glyphs", [&o](Text text) { read_count(text, "--glyphs", 100000, o.picture.glyphs); },
         "vectors as about N arrows, spread evenly (default: 0)")
      ->type_name("N");
  name_group(app, "Pictures (-o FILE.png)");
}

void check_picture_options(const Options& o) {
  if (o.command == Command::voxels) return;  // its files are volumes
  const bool any = std::any_of(o.outputs.begin(), o.outputs.end(), is_picture_path);
  if (!any) {
    for (const char* option : kOptions) {
      if (!o.given(option)) continue;
      throw UsageError(std::string(option) +
                       " has no effect without a picture: give -o FILE.png, or leave it out");
    }
    return;
  }
  if (!kPictures) {
    throw UsageError(
        "this dsc was built without pictures: install Embree and libpng (Debian: libembree-dev "
        "libpng-dev) and build it with -DDSC_WITH_PICTURES=ON, or choose another ending than .png");
  }
  check_have_effect(o);
}

}  // namespace dsc::cli
