/// \file
/// A volume of values in a file, read in slabs, so that a binary volume is made without a
/// copy of the labels.
///
/// Formats, by extension:
/// - `.vol`, `.longvol` (DGtal, simplevol): lines `Key: value` up to a line `.`, then the values, x
///   fastest, then y, then z; one byte each (.vol) or eight little-endian bytes (.longvol). Keys X,
///   Y, Z are required, and Version: 2 (raw) or 3 (zlib). `Voxel-Size` and `Lvoxel-Size` count
///   bytes in a voxel; the spacing is 1 unless the keys `Spacing-X`, `-Y`, `-Z` (ours) give
///   another. `Center-…` and other keys are not used.
/// - `.npy`, versions 1 to 3: a 3-D array indexed [z][y][x], in C or Fortran order, of bool or
///   signed or unsigned integers of 1 to 8 bytes or floats of 4 or 8, either byte order. Spacing
///   1.
/// - `.vox` (MagicaVoxel): one model; the values are the colours' numbers, 1 to 255, and 0 where
///   there is no voxel; z is up. Spacing 1.
/// - `.vti` (VTK's ImageData): the points, or else the cells, of one piece, as integers or floats
/// of
///   any size, as text, base64 or raw, zlib or not, either byte order. The array is the one that
///   the attribute Scalars names, or the only one with one component. Spacing and place in the
///   world as the file has them.
/// - `.vdb` (OpenVDB): one grid of float, double, int32, int64, bool or mask, in the box of its
///   active voxels, in a level set with those of its interior; in the box every voxel has its
///   value, also where it is a tile's or the background, and of a mask the active ones are 1.
///   Spacing and place in the world as the grid's transform has them, which may scale, turn, mirror
///   and move. By OpenVDB, in a process of its own, the program dsc-vdb-reader (option
///   DSC_WITH_OPENVDB).
/// - `.nii`, `.nii.gz`, `.nrrd`, `.nhdr`, `.mha`, `.mhd`, `.tif`, `.tiff` (pages are slices), a
///   folder of TIFF slices (in the natural order of their names) or of one DICOM series: by ITK, in
///   a process of its own, the program dsc-image-reader (option DSC_WITH_ITK). Spacing in
///   millimetres and place in the world as the file has them: the world is LPS, x to the patient's
///   left, y to the back, z to the head, in millimetres, whatever the file's own convention (NIfTI
///   counts x and y the other way). TIFF knows of neither: spacing 1.
/// - but for `.vdb` and images, each of them from standard input, as the path `vol:-`, `npy:-` and
/// so on.
/// - anything, by open_raw_volume(): the values alone, x fastest, then y, then z. Spacing 1.
///
/// The origin is 0: voxel (i, j, k) is centred on spacing * (i, j, k), which is also its place in
/// the world, but for `.vti`, `.vdb` and medical images.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/voxels/grid.h"
#include "libdsc/voxels/rigid_map.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>

namespace dsc {

/// Voxel values in memory that somebody else owns, of the file's own type (bool as 0 and 1 in
/// uint8).
using VoxelValues = std::variant<std::span<const std::uint8_t>, std::span<const std::int8_t>,
                                 std::span<const std::uint16_t>, std::span<const std::int16_t>,
                                 std::span<const std::uint32_t>, std::span<const std::int32_t>,
                                 std::span<const std::uint64_t>, std::span<const std::int64_t>,
                                 std::span<const float>, std::span<const double>>;

/// How a value lies in a file.
struct ValueType {
  int bytes = 1;           ///< 1, 2, 4 or 8
  bool is_signed = false;  ///< of integers
  bool is_float = false;   ///< of 4 or 8 bytes
  bool swap = false;       ///< the file's byte order is not this machine's
};

/// What the values of a volume are, which says what is inside where nobody else does.
enum class VolumeClass {
  values,     ///< anything: every value but 0 is inside
  level_set,  ///< distances with a sign (a class of OpenVDB's grids): values below 0 are inside
  fog_volume  ///< densities (another one): values above 0 are inside
};

/// Consecutive slices [first, last) of a volume.
struct Slab {
  Index first = 0;     ///< slice
  Index last = 0;      ///< one past the last slice
  VoxelValues values;  ///< of all its slices
};

/// A file whose header has been read and checked, and whose values have not.
class VolumeSource {
 public:
  VolumeSource() = default;
  VolumeSource(const VolumeSource&) = delete;
  VolumeSource& operator=(const VolumeSource&) = delete;
  virtual ~VolumeSource() = default;

  /// Of the file, for messages.
  virtual const std::string& path() const = 0;
  /// Of the header.
  virtual const Grid& grid() const = 0;
  /// From grid().position() to the world; the identity for formats that know of no world.
  virtual RigidMap world() const { return {}; }
  /// True: slices are of constant z, and (x, y, z) is at x + X (y + Y (z - first)) of its slab.
  /// False (Fortran order): slices are of constant x, and it is at z + Z (y + Y (x - first)).
  virtual bool x_fastest() const = 0;
  /// Formats that know of no classes have values.
  virtual VolumeClass volume_class() const { return VolumeClass::values; }
  /// Of a `.vdb` file, the grid that is read; else empty.
  virtual std::string grid_name() const { return {}; }

  /// Hands every slab to `take`, in order, each of about 4 MiB. May be called once.
  /// \throws InputError where the data is damaged, too short or too long; what `take` throws.
  virtual void read(const std::function<void(const Slab&)>& take, const Context& context = {}) = 0;
};

/// The extensions that open_volume() knows, for messages and help.
std::string volume_endings();

/// Which volume of a file.
struct VolumeOptions {
  /// The grid of a `.vdb` file by its name, or NAME[N], from 0, where several have that name. Not
  /// needed where the file has only one grid of numbers.
  std::optional<std::string> grid;
};

/// Reads and checks the header. Nothing of the volume's size is allocated.
/// \throws InputError naming the file, the byte and the remedy; UsageError where the extension is
/// not one of the above, or where a grid is asked for of another file than `.vdb`; LimitError where
/// the sizes are beyond counting or memory. The readers of medical images and of `.vdb` get the
/// memory that `context` leaves; one that sends nothing for ten minutes, or for the seconds that
/// the variables DSC_IMAGE_READER_SECONDS and DSC_VDB_READER_SECONDS say, is given up.
std::unique_ptr<VolumeSource> open_volume(const std::string& path, const VolumeOptions& options,
                                          const Context& context = {});
/// The same of a file that has one volume.
std::unique_ptr<VolumeSource> open_volume(const std::string& path, const Context& context = {});

/// What a raw file does not say about itself.
struct RawLayout {
  Index3 size{0, 0, 0};     ///< voxels along x, y, z
  ValueType type;           ///< swap is not used
  bool big_endian = false;  ///< byte order of the values
  Index offset = 0;         ///< bytes before the first value
};

/// The type of one of the names u8, i8, u16, i16, u32, i32, u64, i64, f32, f64.
/// \throws UsageError naming them.
ValueType value_type(const std::string& name);

/// A raw file. \throws InputError where its length is not exactly that of the layout, with both
/// numbers; UsageError where a size is not positive.
std::unique_ptr<VolumeSource> open_raw_volume(const std::string& path, const RawLayout& layout,
                                              const Context& context = {});

}  // namespace dsc
