#include "tests/io/result_parsers.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

namespace dsc::test {
namespace {

void require(bool condition, const std::string& what) {
  if (!condition) throw std::runtime_error(what);
}

std::vector<std::string> split(const std::string& line, char separator) {
  std::vector<std::string> words;
  std::istringstream stream(line);
  for (std::string word; std::getline(stream, word, separator);) words.push_back(word);
  return words;
}

std::vector<double> columns(const std::vector<std::string>& names,
                            const std::vector<std::vector<double>>& rows,
                            const std::vector<std::string>& wanted) {
  std::vector<double> values;
  for (const auto& row : rows) {
    for (const std::string& name : wanted) {
      const auto found = std::find(names.begin(), names.end(), name);
      require(found != names.end(), "no property " + name);
      values.push_back(row.at(static_cast<std::size_t>(found - names.begin())));
    }
  }
  return values;
}

template <class T>
T take(std::istream& in) {
  T value;
  in.read(reinterpret_cast<char*>(&value), sizeof value);
  require(in.gcount() == sizeof value, "the file ends early");
  return value;
}

}  // namespace

std::vector<double> PlyFile::vertex_columns(const std::vector<std::string>& names) const {
  return columns(vertex_names, vertices, names);
}
std::vector<double> PlyFile::face_columns(const std::vector<std::string>& names) const {
  return columns(face_names, face_values, names);
}

PlyFile read_ply(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string line;
  const auto next = [&] {
    require(static_cast<bool>(std::getline(in, line)), "the header ends early");
    return split(line, ' ');
  };
  next();
  require(line == "ply", "magic");
  next();
  require(line == "format binary_little_endian 1.0", "format");
  PlyFile ply;
  std::size_t vertices = 0, faces = 0;
  bool in_faces = false, byte_counts = false, list_first = false;
  for (auto words = next(); line != "end_header"; words = next()) {
    if (words[0] == "comment") continue;
    if (words[0] == "element") {
      in_faces = words.at(1) == "face";
      require(in_faces || words.at(1) == "vertex", "element " + words.at(1));
      (in_faces ? faces : vertices) = std::stoull(words.at(2));
    } else if (words.at(1) == "list") {
      require(in_faces && words.at(3) == "int" && words.at(4) == "vertex_indices", line);
      require(words.at(2) == "uchar" || words.at(2) == "int", line);
      byte_counts = words.at(2) == "uchar";
      list_first = ply.face_names.empty();
    } else {
      require(words.at(0) == "property" && words.at(1) == "double", line);
      (in_faces ? ply.face_names : ply.vertex_names).push_back(words.at(2));
    }
  }
  require(list_first, "the corner list comes first");
  for (std::size_t v = 0; v < vertices; ++v) {
    auto& row = ply.vertices.emplace_back();
    for (std::size_t i = 0; i < ply.vertex_names.size(); ++i) row.push_back(take<double>(in));
  }
  for (std::size_t f = 0; f < faces; ++f) {
    const int n = byte_counts ? take<unsigned char>(in) : take<std::int32_t>(in);
    auto& corners = ply.faces.emplace_back();
    for (int c = 0; c < n; ++c) corners.push_back(take<std::int32_t>(in));
    auto& row = ply.face_values.emplace_back();
    for (std::size_t i = 0; i < ply.face_names.size(); ++i) row.push_back(take<double>(in));
  }
  require(in.peek() == std::char_traits<char>::eof(), "bytes after the last face");
  return ply;
}

namespace {

/// Elements, attributes in double quotes and text; nothing else, as our files need no more.
class XmlParser {
 public:
  explicit XmlParser(const std::string& text) : s_(text) {}

  XmlElement document() {
    if (s_.compare(0, 5, "<?xml") == 0) at_ = s_.find("?>") + 2;
    space();
    XmlElement root = element();
    space();
    require(at_ == s_.size(), "text after the root element");
    return root;
  }

 private:
  void space() {
    while (at_ < s_.size() && std::isspace(static_cast<unsigned char>(s_[at_])) != 0) ++at_;
  }
  bool accept(const std::string& token) {
    if (s_.compare(at_, token.size(), token) != 0) return false;
    at_ += token.size();
    return true;
  }
  void expect(const std::string& token) {
    require(accept(token), "expected " + token + " at byte " + std::to_string(at_));
  }
  std::string name() {
    const std::size_t start = at_;
    while (at_ < s_.size() &&
           (std::isalnum(static_cast<unsigned char>(s_[at_])) != 0 || s_[at_] == '_'))
      ++at_;
    require(at_ > start, "expected a name at byte " + std::to_string(at_));
    return s_.substr(start, at_ - start);
  }

  XmlElement element() {
    expect("<");
    XmlElement e;
    e.name = name();
    for (space(); !accept(">"); space()) {
      if (accept("/>")) return e;
      const std::string key = name();
      expect("=\"");
      const std::size_t end = s_.find('"', at_);
      require(end != std::string::npos, "an attribute does not end");
      const std::string value = s_.substr(at_, end - at_);
      require(value.find_first_of("<&") == std::string::npos, "a bare < or & in an attribute");
      require(e.attributes.emplace(key, value).second, "attribute " + key + " twice");
      at_ = end + 1;
    }
    while (true) {
      const std::size_t next = s_.find('<', at_);
      require(next != std::string::npos, e.name + " does not end");
      const std::string text = s_.substr(at_, next - at_);
      for (const unsigned char c : text) {
        require(c != '&' && (c >= 0x20 || std::isspace(c) != 0) && c < 0x80, "a byte XML forbids");
      }
      e.text += text;
      at_ = next;
      if (accept("</")) {
        require(name() == e.name, e.name + " is closed by another name");
        expect(">");
        return e;
      }
      e.children.push_back(element());
    }
  }

  const std::string& s_;
  std::size_t at_ = 0;
};

/// Decodes until padding or the end; the bytes of the first stream only.
std::string from_base64(const std::string& text, std::size_t from, std::size_t bytes) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  unsigned bits = 0;
  int have = 0;
  for (std::size_t i = from; out.size() < bytes; ++i) {
    const std::size_t digit = i < text.size() ? digits.find(text[i]) : std::string::npos;
    require(digit != std::string::npos, "base64 ends early");
    bits = bits << 6 | static_cast<unsigned>(digit);
    have += 6;
    if (have >= 8) {
      have -= 8;
      out += static_cast<char>(bits >> have & 255U);
    }
  }
  return out;
}

template <class T>
std::vector<T> values(const std::string& bytes) {
  require(bytes.size() % sizeof(T) == 0, "a piece of a value");
  std::vector<T> result(bytes.size() / sizeof(T));
  if (!result.empty()) std::memcpy(result.data(), bytes.data(), bytes.size());
  return result;
}

}  // namespace

XmlElement read_xml(const std::string& text) { return XmlParser(text).document(); }

const XmlElement& XmlElement::child(const std::string& child_name) const {
  for (const XmlElement& c : children) {
    if (c.name == child_name) return c;
  }
  throw std::runtime_error("no element " + child_name + " in " + name);
}

const XmlElement& VtpFile::array(const std::string& section, const std::string& name) const {
  for (const XmlElement& a : piece.child(section).children) {
    if (a.name == "DataArray" && a.attributes.at("Name") == name) return a;
  }
  throw std::runtime_error("no array " + name + " in " + section);
}

std::string VtpFile::bytes(const XmlElement& a) const {
  require(a.attributes.at("format") == "appended", "format");
  const std::size_t offset = std::stoull(a.attributes.at("offset"));
  const std::uint64_t size = values<std::uint64_t>(from_base64(appended, offset, 8)).front();
  const std::string all = from_base64(appended, offset, 8 + size);
  // The stream ends with its padding; the next one starts at a multiple of four.
  const std::size_t end = offset + (8 + size + 2) / 3 * 4;
  require(offset % 4 == 0 && end <= appended.size(), "offset");
  const std::size_t padding = (3 - (8 + size) % 3) % 3;
  require(appended.substr(end - padding, padding) == std::string(padding, '='), "padding");
  return all.substr(8);
}

std::vector<double> VtpFile::doubles(const std::string& section, const std::string& name,
                                     int components) const {
  const XmlElement& a = array(section, name);
  require(a.attributes.at("type") == "Float64", "type");
  require(a.attributes.at("NumberOfComponents") == std::to_string(components), "components");
  return values<double>(bytes(a));
}

std::vector<Index> VtpFile::integers(const std::string& section, const std::string& name) const {
  const XmlElement& a = array(section, name);
  if (a.attributes.at("type") == "Int64") return values<Index>(bytes(a));
  require(a.attributes.at("type") == "Int32", "type");
  const auto narrow = values<std::int32_t>(bytes(a));
  return {narrow.begin(), narrow.end()};
}

std::vector<std::string> VtpFile::parts(const std::string& section, const std::string& name) const {
  std::vector<std::string> parts;
  const auto& attributes = array(section, name).attributes;
  for (int i = 0; attributes.count("ComponentName" + std::to_string(i)) > 0; ++i) {
    parts.push_back(attributes.at("ComponentName" + std::to_string(i)));
  }
  return parts;
}

VtpFile read_vtp(const std::string& path) {
  const XmlElement root = read_xml(read_text(path));
  require(root.name == "VTKFile" && root.attributes.at("type") == "PolyData" &&
              root.attributes.at("byte_order") == "LittleEndian" &&
              root.attributes.at("header_type") == "UInt64",
          "VTKFile");
  VtpFile vtp;
  vtp.piece = root.child("PolyData").child("Piece");
  vtp.points = std::stoll(vtp.piece.attributes.at("NumberOfPoints"));
  vtp.polys = std::stoll(vtp.piece.attributes.at("NumberOfPolys"));
  const XmlElement& data = root.child("AppendedData");
  require(data.attributes.at("encoding") == "base64", "encoding");
  const std::size_t start = data.text.find('_');
  require(start != std::string::npos, "underscore");
  const std::size_t end = data.text.find_last_not_of(" \n");
  vtp.appended = data.text.substr(start + 1, end - start);
  return vtp;
}

CsvFile read_csv(const std::string& path) {
  std::ifstream in(path);
  CsvFile csv;
  std::string line;
  require(static_cast<bool>(std::getline(in, line)), "no header");
  csv.header = split(line, ',');
  while (std::getline(in, line)) {
    auto& row = csv.rows.emplace_back();
    for (const std::string& word : split(line, ',')) {
      char* end = nullptr;
      row.push_back(std::strtod(word.c_str(), &end));
      require(!word.empty() && *end == '\0', "not a number: " + word);
    }
    require(row.size() == csv.header.size(), "a row of another length");
  }
  return csv;
}

std::string read_text(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  require(in.is_open(), "cannot open " + path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace dsc::test
