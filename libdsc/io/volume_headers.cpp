#include "libdsc/io/volume_headers.h"

#include <charconv>

namespace dsc::detail {
namespace {

std::string number(double value) {
  char buffer[32];
  return {buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr};
}

}  // namespace

std::string vol_header(const Grid& grid, bool longvol, bool compress) {
  const char* const axes[] = {"X", "Y", "Z"};
  std::string text;
  for (std::size_t a = 0; a < 3; ++a) {
    text += std::string("Center-") + axes[a] + ": " + std::to_string(grid.size[a] / 2) + "\n";
  }
  for (std::size_t a = 0; a < 3; ++a) {
    text += std::string(axes[a]) + ": " + std::to_string(grid.size[a]) + "\n";
  }
  if (grid.spacing != Vec3::Ones()) {
    for (std::size_t a = 0; a < 3; ++a) {
      text += std::string("Spacing-") + axes[a] + ": " + number(grid.spacing[int(a)]) + "\n";
    }
  }
  const std::string prefix = longvol ? "Lvoxel" : "Voxel";
  return text + prefix + "-Size: " + (longvol ? "8" : "1") + "\nAlpha-Color: 0\n" + prefix +
         "-Endian: 0\nInt-Endian: 0123\nVersion: " + (compress ? "3" : "2") + "\n.\n";
}

std::string npy_header(const Grid& grid, const std::string& descr) {
  std::string text = "{'descr': '" + descr + "', 'fortran_order': False, 'shape': (" +
                     std::to_string(grid.size[2]) + ", " + std::to_string(grid.size[1]) + ", " +
                     std::to_string(grid.size[0]) + "), }";
  text.append(63 - (10 + text.size()) % 64, ' ');  // the data begins at a multiple of 64
  text += '\n';
  const auto length = static_cast<unsigned>(text.size());
  const std::string start = {'\x93',
                             'N',
                             'U',
                             'M',
                             'P',
                             'Y',
                             '\x01',
                             '\x00',
                             static_cast<char>(length & 255),
                             static_cast<char>(length >> 8)};
  return start + text;
}

std::string vti_header(const Grid& grid, const RigidMap& world, const std::string& type,
                       bool compress) {
  const auto numbers = [](const auto& v) {
    std::string text;
    for (Index i = 0; i < v.size(); ++i) text += (i > 0 ? " " : "") + number(v(i));
    return text;
  };
  std::string extent;
  for (const Index size : grid.size) {
    extent += (extent.empty() ? "0 " : " 0 ") + std::to_string(size - 1);
  }
  const Mat3 rows = world.rotation.transpose();  // Eigen counts down the columns
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"ImageData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\"";
  if (compress) text += " compressor=\"vtkZLibDataCompressor\"";
  text += ">\n<ImageData WholeExtent=\"" + extent + "\" Origin=\"" + numbers(world(grid.origin)) +
          "\" Spacing=\"" + numbers(grid.spacing) + "\"";
  if (!world.rotation.isIdentity(0)) text += " Direction=\"" + numbers(rows.reshaped()) + "\"";
  return text + ">\n<Piece Extent=\"" + extent +
         "\">\n<PointData Scalars=\"values\">\n<DataArray type=\"" + type +
         "\" Name=\"values\" format=\"appended\" offset=\"0\"/>\n</PointData>\n</Piece>\n"
         "</ImageData>\n<AppendedData encoding=\"raw\">\n_";
}

}  // namespace dsc::detail
