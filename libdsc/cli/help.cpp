#include "libdsc/cli/help.h"

#include "libdsc/io/results.h"
#include "libdsc/voxels/shape_spec.h"

#include <sstream>

namespace dsc::cli {

std::string help_footer() {
  std::string text = "Shapes (shape:NAME[,key=value...] with --gridstep H):\n";
  for (const std::string& line : known_shapes()) text += "  " + line + "\n";
  text +=
      "\nResults: " + result_endings() +
      ", .glb, coloured,\n"
      "for viewers of 3-D models, .png, a picture,\n"
      "and .html, a page that any browser opens: the surface to turn, colour, cut and read\n"
      "FORMAT:- is standard input or output: dsc normals vol:- -o ply:- < object.vol\n"
      "In .vtp the vectors are the arrays normal (nx, ny, nz) and gradient (gx, gy, gz).\n"
      "With --labels and --between the faces also carry label_inner and label_outer: surfaces run\n"
      "from the smaller label to the larger, 0 is always outside.\n"
      "Points and functions are in world units: of medical images millimetres, LPS (x to the "
      "left,\n"
      "y to the back, z to the head), and results come out there.\n\n"
      "Exit codes: 0 done, 2 wrong usage, 3 bad input or output, 4 too large, 5 a solver failed,\n"
      "130 interrupted.\n\n"
      "Start here:\n"
      "  dsc info object.vol\n"
      "  dsc geodesic shape:sphere --gridstep 0.05 --source 0,0,1 -o distance.vtp\n"
      "  dsc geodesic --help";
  return text;
}

std::string help_footer(Command command) {
  switch (command) {
    case Command::info:
      return "Examples:\n"
             "  dsc info object.vol\n"
             "  dsc info scan.raw --size 512,512,300 --type i16 --threshold 300,3000\n"
             "  dsc info labels.npy --label 3 --label 4 --report counts.json\n"
             "  dsc info shape:torus,R=2,r=0.5 --gridstep 0.05\n"
             "  dsc info mesh.obj";
    case Command::voxels:
      return "Voxels inside are written as 1, the others as 0; with --labels all each voxel as its "
             "label,\n"
             "up to 255 in .vol. Spacing and place in the world are kept by .vti, the spacing by "
             ".vol and\n"
             ".longvol, neither by .npy; what is lost is warned of.\n"
             "Examples:\n"
             "  dsc voxels shape:torus --gridstep 0.02 -o torus.vol\n"
             "  dsc voxels ct.nii.gz --threshold 300,3000 -o bone.vti\n"
             "  dsc voxels labels.nrrd --labels all -o labels.npy\n"
             "  dsc voxels scan.raw --size 512,512,300 --type i16 --threshold 300,3000 -o vol:- |\n"
             "    dsc surface vol:- -o scan.ply";
    case Command::surface:
      return "Examples:\n"
             "  dsc surface object.vol -o surface.ply\n"
             "  dsc surface labels.npy --labels all -o interfaces.vtp\n"
             "  dsc surface labels.npy --between 3,7 -o contact.ply\n"
             "  dsc surface ct.npy --threshold 300,3000 --border open -o bone.vtp\n"
             "  dsc surface shape:goursat --gridstep 0.2 --adjacency exterior -o goursat.ply\n"
             "  dsc surface object.vol --regularise -o smooth.ply\n"
             "  dsc surface mesh.off -o mesh.om -o mesh.stl";
    case Command::normals:
      return "Fields: nx, ny, nz per face, unit, outwards.\n"
             "For shapes the angle to the exact normals is reported, in radians.\n"
             "Examples:\n"
             "  dsc normals object.vol -o normals.vtp\n"
             "  dsc normals object.vol --radius 6 --centre pair -o normals.csv\n"
             "  dsc normals shape:sphere --gridstep 0.05 --estimator trivial";
    case Command::gradient:
      return "Fields: gx, gy, gz per face. The function is taken at the vertices; for shapes, at "
             "the\n"
             "points of the shape closest to them, and the error is reported against the exact\n"
             "tangential gradient.\n"
             "Examples:\n"
             "  dsc gradient object.vol --function 'x^2 + y*z' -o gradient.vtp\n"
             "  dsc gradient shape:sphere --gridstep 0.05 --function 'sin(3*x)' --report g.json";
    case Command::diffuse:
      return "Field: heat per vertex, (M0 - T L)^-1 of a unit of heat at each source.\n"
             "Examples:\n"
             "  dsc diffuse object.vol --source 10,20,30 --time 100 -o heat.vtp\n"
             "  dsc diffuse shape:sphere --gridstep 0.05 --source 0,0,1 --time 0.1 -o heat.csv";
    case Command::geodesic:
      return "Field: distance per vertex, world units, to the nearest source; infinite where no "
             "source\n"
             "reaches. For spheres and planes the error is reported. With --stabilisation mercat "
             "heat "
             "is\n"
             "diffused with --lambda all the same, since half of a point source is a "
             "checkerboard.\n"
             "Examples:\n"
             "  dsc geodesic object.vol --source 10,20,30 -o distance.vtp\n"
             "  dsc geodesic object.vol --source 10,20,30 -o distance.png --view front --isolines "
             "20\n"
             "  dsc geodesic object.vol --source-vertex 0 --source-vertex 999 -o distance.csv\n"
             "  dsc geodesic shape:sphere --gridstep 0.1 --source 0.3,0.5,0.81 --calculus naive";
    case Command::spectrum:
      return "Eigenvalues of -M0^-1 L, ascending, in the report; no copy of a multiple one is "
             "lost.\n"
             "Fields: eigenvector_0, eigenvector_1, ... per vertex, orthonormal with respect to "
             "M0.\n"
             "For spheres the error against l (l + 1) / r^2 is reported. With --stabilisation "
             "mercat\n"
             "checkerboards are eigenvectors too; they are left out and counted.\n"
             "Examples:\n"
             "  dsc spectrum object.vol -k 20 -o modes.vtp --report spectrum.json\n"
             "  dsc spectrum shape:sphere --gridstep 0.1 -k 16 --stabilisation mercat";
    case Command::curvature:
      return "Fields of ii: mean_curvature, gaussian_curvature, kappa_1 <= kappa_2 and their "
             "directions\n"
             "(k1x, k1y, k1z), (k2x, k2y, k2z) per face; of laplacian: mean_curvature per vertex, "
             "of the\n"
             "shape's points closest to the vertices, or of regularised positions where there is "
             "no shape.\n"
             "Positive where the object is convex. For shapes the errors are reported.\n"
             "Examples:\n"
             "  dsc curvature object.vol -o curvature.vtp\n"
             "  dsc curvature object.vol --radius 12 --on vertex -o curvature.ply\n"
             "  dsc curvature object.vol --estimator laplacian --diffuse 10 -o h.vtp\n"
             "  dsc curvature shape:torus --gridstep 0.02 --radius 0.25 --report errors.json";
    case Command::laplacian:
      return "Fields: function, laplacian per vertex: M0^-1 L f, with --diffuse T (M0 - T L)^-1 L "
             "f. The\n"
             "function is taken at the points of the shape closest to the vertices, and the error "
             "is\n"
             "reported; where there is no shape, at regularised positions. Pointwise it does not "
             "converge.\n"
             "Examples:\n"
             "  dsc laplacian object.vol --function 'x*y' --diffuse 10 -o laplacian.vtp\n"
             "  dsc laplacian shape:sphere --gridstep 0.05 --function 'x^2' --diffuse 0.00175";
    case Command::poisson:
      return "Field: solution u per vertex, with Laplacian of u = the right-hand side (no minus "
             "sign). On\n"
             "the boundary of the surface u takes the values of --fix. Where a component has none, "
             "u is\n"
             "determined up to a constant: it gets the mean 0, and the mean of the right-hand side "
             "is\n"
             "taken away first and reported. With --stabilisation mercat that holds for each of "
             "the "
             "two\n"
             "parities of a component.\n"
             "Examples:\n"
             "  dsc poisson object.vol --rhs 'x*y' -o u.vtp\n"
             "  dsc poisson half.vol --border open --rhs 1 --fix 0 -o membrane.vtp\n"
             "  dsc poisson shape:sphere --gridstep 0.05 --rhs '-2*x' -o x.csv";
  }
  return "";
}

std::string wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 96;
  const std::string indent(30, ' ');  // CLI11's column of descriptions
  std::string result;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    while (line.size() > kWidth) {
      const std::size_t blank = line.rfind(' ', kWidth);
      if (blank == std::string::npos || blank <= indent.size()) break;
      result += line.substr(0, blank) + "\n";
      line.replace(0, blank + 1, indent);
    }
    result += line + "\n";
  }
  return result;
}

}  // namespace dsc::cli
