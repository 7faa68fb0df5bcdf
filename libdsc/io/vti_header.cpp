#include "libdsc/io/vti_header.h"

#include "libdsc/base/error.h"
#include "libdsc/io/data_size.h"

#include <expat.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace dsc::detail {
namespace {

struct Array {
  std::string name, type, format;
  Index at = 0;       ///< its tag, for messages
  Index content = 0;  ///< the byte after its tag
  Index offset = 0;   ///< into the appended data
  Index components = 1;
  bool of_cells = false;
};

/// What the file says, as it is read; exceptions must not pass through expat, which is C.
class Document {
 public:
  explicit Document(InputFile& file)
      : file_(file), parser_(XML_ParserCreate(nullptr), &XML_ParserFree) {
    if (!parser_) throw LimitError("'" + file.path() + "': no memory to read its XML");
    XML_SetUserData(parser_.get(), this);
    XML_SetElementHandler(parser_.get(), &Document::on_start, &Document::on_end);
    XML_SetCharacterDataHandler(parser_.get(), &Document::on_text);
    XML_SetStartDoctypeDeclHandler(parser_.get(), &Document::on_doctype);
  }

  void parse() {
    std::vector<char> buffer(std::size_t{1} << 16);
    while (!appended_at_) {
      const Index n = file_.read_some(buffer.data(), static_cast<Index>(buffer.size()));
      const XML_Status status = XML_Parse(parser_.get(), buffer.data(), static_cast<int>(n),
                                          n == 0 ? XML_TRUE : XML_FALSE);
      if (!error_.empty()) file_.fail(error_at_, error_);
      if (appended_at_) return;
      if (status != XML_STATUS_OK) {
        file_.fail(
            XML_GetCurrentByteIndex(parser_.get()),
            std::string("the XML is damaged: ") + XML_ErrorString(XML_GetErrorCode(parser_.get())));
      }
      if (n == 0) return;
    }
  }

  std::array<double, 6> extent{};
  Vec3 origin{0., 0., 0.}, spacing{1., 1., 1.};
  Mat3 direction = Mat3::Identity();
  bool big_endian = false, wide = false, compressed = false, image = false;
  bool appended_raw = false;
  std::optional<Index> appended_at_;  ///< the byte after the '_' that begins the appended data
  std::vector<Array> arrays;
  std::string point_scalars, cell_scalars;

 private:
  using Attributes = const char**;

  static void on_start(void* self, const char* name, Attributes attributes) {
    auto& document = *static_cast<Document*>(self);
    try {
      document.start(name, attributes);
    } catch (const std::exception& error) {
      document.stop(error.what());
    }
  }
  static void on_end(void* self, const char* name) {
    const std::string_view ended = name;
    if (ended == "PointData" || ended == "CellData") static_cast<Document*>(self)->part_.clear();
  }
  static void on_doctype(void* self, const char*, const char*, const char*, int) {
    static_cast<Document*>(self)->stop("a document type has no place in a .vti file");
  }
  /// Appended data begins after the first '_'.
  static void on_text(void* self, const char* text, int size) {
    auto& document = *static_cast<Document*>(self);
    if (document.part_ != "AppendedData" || document.appended_at_) return;
    const std::string_view all(text, static_cast<std::size_t>(size));
    const std::size_t at = all.find('_');
    if (at == std::string_view::npos) return;
    document.appended_at_ = document.here() + static_cast<Index>(at) + 1;
    XML_StopParser(document.parser_.get(), XML_FALSE);
  }

  Index here() const { return XML_GetCurrentByteIndex(parser_.get()); }

  void stop(const std::string& why) {
    if (!error_.empty()) return;
    error_ = why;
    error_at_ = here();
    XML_StopParser(parser_.get(), XML_FALSE);
  }

  static std::string_view get(Attributes attributes, std::string_view key) {
    for (; *attributes != nullptr; attributes += 2) {
      if (key == attributes[0]) return attributes[1];
    }
    return {};
  }

  /// `count` finite numbers, or `whole` ones.
  template <class Numbers>
  static void numbers(Attributes attributes, const char* key, Numbers& to, std::size_t count) {
    std::string_view text = get(attributes, key);
    for (std::size_t i = 0; i < count; ++i) {
      text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
      double value = 0;
      const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
      if (error != std::errc{} || !std::isfinite(value)) {
        throw InputError(std::string(key) + " must be " + std::to_string(count) + " numbers");
      }
      to[static_cast<decltype(+i)>(i)] = value;
      text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    if (text.find_first_not_of(" \t\r\n") != std::string_view::npos) {
      throw InputError(std::string(key) + " must be " + std::to_string(count) + " numbers");
    }
  }

  static Index whole(std::string_view text, const char* key) {
    Index value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value < 0) {
      throw InputError(std::string(key) + " must be a whole number, not negative");
    }
    return value;
  }

  void start(std::string_view name, Attributes attributes) {
    if (name == "VTKFile") {
      if (get(attributes, "type") != "ImageData") {
        throw InputError("the file holds '" + std::string(get(attributes, "type")) +
                         "'; only ImageData has voxels");
      }
      big_endian = get(attributes, "byte_order") == "BigEndian";
      wide = get(attributes, "header_type") == "UInt64";
      const std::string_view by = get(attributes, "compressor");
      if (!by.empty() && by != "vtkZLibDataCompressor") {
        throw InputError("compression by " + std::string(by) +
                         " is not read; write the file anew with vtkZLibDataCompressor or none");
      }
      compressed = !by.empty();
    } else if (name == "ImageData") {
      image = true;
      numbers(attributes, "WholeExtent", extent, 6);
      if (!get(attributes, "Origin").empty()) numbers(attributes, "Origin", origin, 3);
      if (!get(attributes, "Spacing").empty()) numbers(attributes, "Spacing", spacing, 3);
      if (!get(attributes, "Direction").empty()) {
        std::array<double, 9> rows{};
        numbers(attributes, "Direction", rows, 9);
        for (int i = 0; i < 9; ++i) direction(i / 3, i % 3) = rows[static_cast<std::size_t>(i)];
      }
    } else if (name == "Piece") {
      std::array<double, 6> piece{};
      numbers(attributes, "Extent", piece, 6);
      if (piece != extent) {
        throw InputError("the image is in pieces; write it as one");
      }
    } else if (name == "PointData" || name == "CellData") {
      part_ = name;
      (name == "PointData" ? point_scalars : cell_scalars) = get(attributes, "Scalars");
    } else if (name == "DataArray" && (part_ == "PointData" || part_ == "CellData")) {
      Array array;
      array.name = get(attributes, "Name");
      array.type = get(attributes, "type");
      array.format = get(attributes, "format");
      array.at = here();
      array.content = here() + XML_GetCurrentByteCount(parser_.get());
      if (array.format == "appended") array.offset = whole(get(attributes, "offset"), "offset");
      const std::string_view components = get(attributes, "NumberOfComponents");
      if (!components.empty()) array.components = whole(components, "NumberOfComponents");
      array.of_cells = part_ == "CellData";
      arrays.push_back(std::move(array));
    } else if (name == "AppendedData") {
      part_ = name;
      appended_raw = get(attributes, "encoding") == "raw";
    }
  }

  InputFile& file_;
  std::unique_ptr<XML_ParserStruct, decltype(&XML_ParserFree)> parser_;
  std::string part_;  ///< PointData, CellData, AppendedData or none
  std::string error_;
  Index error_at_ = 0;
};

const Array& chosen(const Document& document, const InputFile& file) {
  std::vector<const Array*> scalars;
  std::string names;
  for (const Array& array : document.arrays) {
    if (array.components != 1) continue;
    scalars.push_back(&array);
    names += (names.empty() ? "" : ", ") + array.name;
  }
  for (const bool cells : {false, true}) {
    const std::string& wanted = cells ? document.cell_scalars : document.point_scalars;
    for (const Array* array : scalars) {
      if (!wanted.empty() && array->of_cells == cells && array->name == wanted) return *array;
    }
  }
  if (scalars.size() == 1) return *scalars.front();
  if (scalars.empty()) file.fail(0, "no array with one value a point or cell is there");
  file.fail(scalars[1]->at,
            "of the arrays " + names + " none is named by the attribute Scalars; keep one");
}

ValueType type_of(const Array& array, const InputFile& file, bool big_endian) {
  for (const int bytes : {1, 2, 4, 8}) {
    const std::string bits = std::to_string(8 * bytes);
    const bool swap = bytes > 1 && big_endian != (std::endian::native == std::endian::big);
    if (array.type == "Int" + bits) return {bytes, true, false, swap};
    if (array.type == "UInt" + bits) return {bytes, false, false, swap};
    if (bytes >= 4 && array.type == "Float" + bits) return {bytes, false, true, swap};
  }
  file.fail(array.at, "values of type '" + array.type + "' are not read");
}

/// Voxels are the image's points, or its cells, whose centres lie half a step on.
void place(VtiHeader& header, const Document& document, const Array& array, const InputFile& file) {
  Vec3 first;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = document.extent[2 * axis], high = document.extent[2 * axis + 1];
    const bool whole = low == std::floor(low) && high == std::floor(high) && high >= low &&
                       std::abs(low) < 0x1p52 && high - low < 0x1p40;
    if (!whole) file.fail(0, "WholeExtent must be whole numbers, each axis from low to high");
    const Index steps = static_cast<Index>(high - low);
    const bool between = array.of_cells && steps > 0;  // a flat image has one layer of cells
    header.grid.size[axis] = between ? steps : steps + 1;
    first[static_cast<Index>(axis)] = low + (between ? 0.5 : 0.);
  }
  header.grid.spacing = document.spacing;
  try {
    header.grid.check();
    header.world =
        rigid_map(document.direction,
                  document.origin + document.direction * document.spacing.cwiseProduct(first));
  } catch (const InputError& error) {
    file.fail(0, error.what());
  } catch (const LimitError& error) {
    throw LimitError("'" + file.path() + "', byte 0: " + header.grid.text() +
                     " are too large: " + error.what());
  }
}

}  // namespace

VtiHeader read_vti_header(InputFile& file) {
  Document document(file);
  document.parse();
  if (!document.image) file.fail(0, "the element ImageData is missing; is this a .vti file?");
  const Array& array = chosen(document, file);
  VtiHeader header;
  header.type = type_of(array, file, document.big_endian);
  place(header, document, array, file);
  header.compressed = document.compressed;
  header.word_bytes = document.wide ? 8 : 4;
  header.swap_words = document.big_endian != (std::endian::native == std::endian::big);
  if (array.format == "appended") {
    if (!document.appended_at_) file.fail(file.size(), "the appended data is missing");
    header.encoding = document.appended_raw ? VtiEncoding::raw : VtiEncoding::base64;
    if (array.offset > file.size() - *document.appended_at_) {
      file.fail(array.at, "its offset " + std::to_string(array.offset) + " is beyond the file");
    }
    header.begin = *document.appended_at_ + array.offset;
  } else if (array.format == "binary") {
    header.encoding = VtiEncoding::base64;
    header.begin = array.content;
  } else if (array.format == "ascii" || array.format.empty()) {
    header.encoding = VtiEncoding::ascii;
    header.type.swap = false;
    header.begin = array.content;
  } else {
    file.fail(array.at, "the format '" + array.format + "' is unknown");
  }
  return header;
}

}  // namespace dsc::detail
