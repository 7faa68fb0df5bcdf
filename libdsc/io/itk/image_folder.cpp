// A folder with the slices of one volume, one a file.
#include "libdsc/io/itk/dicom_elements.h"
#include "libdsc/io/itk/image.h"

#include <itkGDCMSeriesFileNames.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <vector>

namespace dsc::detail {
namespace {

using Point = std::array<double, 3>;

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double length(const Point& a) { return std::hypot(a[0], a[1], a[2]); }

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// slice9 before slice10: runs of digits count as numbers.
bool natural_less(const std::string& a, const std::string& b) {
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (is_digit(a[i]) && is_digit(b[j])) {
      const auto number = [](const std::string& text, std::size_t& at) {
        while (at < text.size() && text[at] == '0') ++at;
        const std::size_t begin = at;
        while (at < text.size() && is_digit(text[at])) ++at;
        return text.substr(begin, at - begin);
      };
      const std::string m = number(a, i), n = number(b, j);
      if (m.size() != n.size()) return m.size() < n.size();
      if (m != n) return m < n;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  return a.size() - i != b.size() - j ? a.size() - i < b.size() - j : a < b;
}

bool is_tiff(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  return extension == ".tif" || extension == ".tiff" || extension == ".TIF" || extension == ".TIFF";
}

/// Files of equal size and type, one slice each.
class Slices final : public Image {
 public:
  Slices(std::vector<std::string> paths, bool placed) : paths_(std::move(paths)) {
    std::vector<Point> origins;
    for (const std::string& path : paths_) {
      const ImageHeader slice = header_of(*open_image_file(path));
      if (slice.size[2] != 1) fail(path, "more than one slice in a file of a stack");
      if (origins.empty()) header_ = slice;
      const bool equal = std::equal(slice.size, slice.size + 3, header_.size) &&
                         slice.bytes == header_.bytes && slice.kind == header_.kind;
      if (!equal) fail(path, "another size or type of values than the first slice's");
      origins.push_back({slice.origin[0], slice.origin[1], slice.origin[2]});
    }
    header_.size[2] = static_cast<std::int64_t>(paths_.size());
    if (placed) {
      place(origins);
    } else {
      std::fill_n(header_.spacing, 3, 1.);
    }
  }

  ImageHeader header() const override { return header_; }

  void read(const TakeBytes& take) override {
    ImageHeader slice = header_;
    slice.size[2] = 1;
    for (const std::string& path : paths_) read_values(*open_image_file(path), slice, take);
  }

 private:
  [[noreturn]] static void fail(const std::string& path, const std::string& why) {
    throw ImageError("slice '" + path + "': " + why);
  }

  /// The third axis from where the slices lie.
  void place(const std::vector<Point>& origins) {
    if (origins.size() < 2) return;
    Point step = difference(origins.back(), origins.front());
    for (double& s : step) s /= static_cast<double>(origins.size() - 1);
    header_.spacing[2] = length(step);
    if (!(header_.spacing[2] > 0)) throw ImageError("the slices of the series lie on each other");
    for (unsigned row = 0; row < 3; ++row) {
      header_.direction[3 * row + 2] = step[row] / header_.spacing[2];
    }
    for (std::size_t i = 1; i < origins.size(); ++i) {
      const Point off = difference(difference(origins[i], origins[i - 1]), step);
      if (length(off) > 0.01 * header_.spacing[2]) {
        fail(paths_[i], "it is " + std::to_string(length(difference(origins[i], origins[i - 1]))) +
                            " mm from the one before, the mean is " +
                            std::to_string(header_.spacing[2]) +
                            "; slices are missing or uneven: resample the series");
      }
    }
  }

  std::vector<std::string> paths_;
  ImageHeader header_{};
};

std::unique_ptr<Image> open_series(const std::string& path) {
  // Before GDCM looks for series, and aborts on a file that ends early. It passes over other files.
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    const std::string file = entry.path().string();
    if (!entry.is_regular_file() || !has_dicom_mark(file)) continue;
    try {
      (void)find_dicom_pixels(file);
    } catch (const ImageError& error) {
      throw ImageError("slice '" + file + "': " + error.what());
    }
  }
  const auto names = itk::GDCMSeriesFileNames::New();
  names->SetUseSeriesDetails(true);
  names->SetDirectory(path);
  const auto& series = names->GetSeriesUIDs();
  if (series.empty()) throw ImageError("the folder holds neither TIFF slices nor a DICOM series");
  if (series.size() > 1) {
    throw ImageError("the folder holds " + std::to_string(series.size()) +
                     " DICOM series; put each into a folder of its own");
  }
  return std::make_unique<Slices>(names->GetFileNames(series.front()), true);
}

}  // namespace

std::unique_ptr<Image> open_folder(const std::string& path) {
  std::vector<std::string> slices;
  for (const auto& entry : std::filesystem::directory_iterator(path)) {
    if (entry.is_regular_file() && is_tiff(entry.path())) slices.push_back(entry.path().string());
  }
  if (slices.empty()) return open_series(path);
  std::sort(slices.begin(), slices.end(), natural_less);
  return std::make_unique<Slices>(std::move(slices), false);
}

}  // namespace dsc::detail
