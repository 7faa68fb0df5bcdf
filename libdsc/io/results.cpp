#include "libdsc/io/results.h"

#include "libdsc/base/parallel.h"
#include "libdsc/io/atomic_file.h"
#include "libdsc/io/result_writers.h"
#include "libdsc/io/path_extension.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <filesystem>

namespace dsc {

static_assert(std::endian::native == std::endian::little, "the writers copy little-endian memory");

namespace {

enum class Format { ply, vtp, csv, off, obj, stl, om };

struct Ending {
  const char* text;
  Format format;
};
constexpr std::array<Ending, 7> kEndings{{{".ply", Format::ply},
                                          {".vtp", Format::vtp},
                                          {".csv", Format::csv},
                                          {".off", Format::off},
                                          {".obj", Format::obj},
                                          {".stl", Format::stl},
                                          {".om", Format::om}}};

Format format_of(const std::string& path) {
  const std::string ending = extension_of(path);
  for (const Ending& known : kEndings) {
    if (ending == known.text) return known.format;
  }
  throw UsageError(
      "'" + path +
      "': " + (ending.empty() ? "no ending tells" : "the ending '" + ending + "' does not tell") +
      " the format of the result; known are " + result_endings());
}

/// The first index at which `is_bad` holds of a value, or -1.
template <class IsBad>
Index first_bad(std::span<const double> values, const IsBad& is_bad, const Context& context) {
  const auto n = static_cast<Index>(values.size());
  return parallel_reduce(
      context, n, Index{1} << 16, Index{-1},
      [&](Index first, Index last) {
        for (Index i = first; i < last; ++i) {
          if (is_bad(values[static_cast<std::size_t>(i)])) return i;
        }
        return Index{-1};
      },
      [](Index a, Index b) { return a >= 0 ? a : b; });
}

void check_mesh(const FlatMesh& mesh, const Context& context) {
  const Vec3View positions = mesh.positions;
  const Index bad = first_bad(
      {positions.data, static_cast<std::size_t>(3 * positions.size)},
      [](double value) { return !std::isfinite(value); }, context);
  if (bad >= 0) {
    throw InputError("the position of vertex " + std::to_string(bad / 3) + " is not finite");
  }
  for (std::size_t c = 0; c < mesh.corners.size(); ++c) {
    if (mesh.corners[c] < 0 || mesh.corners[c] >= mesh.vertices()) {
      throw InputError("corner " + std::to_string(c) + " of the mesh is vertex " +
                       std::to_string(mesh.corners[c]) + " of " + std::to_string(mesh.vertices()));
    }
  }
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_';
  });
}

void check_field(const Field& field, const FlatMesh& mesh, const Context& context) {
  const char* kind = field.on == FieldOn::vertex ? "vertex" : "face";
  const Index count = field.on == FieldOn::vertex ? mesh.vertices() : mesh.faces();
  const auto parts = static_cast<Index>(field.parts.size());
  const auto size = static_cast<Index>(field.values.size());
  for (const std::string& name : field.parts) {
    if (!is_plain_name(name) || name == "x" || name == "y" || name == "z") {
      throw UsageError("a field cannot be called '" + name +
                       "': use letters, digits and underscores, and not x, y or z");
    }
  }
  if (!is_plain_name(field.name)) throw UsageError("a field cannot be called '" + field.name + "'");
  if (parts < 1 || size != parts * count) {
    throw UsageError("field " + field.name + ": " + std::to_string(size) + " values for " +
                     std::to_string(count) +
                     (field.on == FieldOn::vertex ? " vertices" : " faces") + " of " +
                     std::to_string(parts) + " each");
  }
  const Index nan = first_bad(
      field.values, [](double value) { return std::isnan(value); }, context);
  if (nan >= 0) {
    throw InputError("field " + field.name + " is not a number at " + kind + " " +
                     std::to_string(nan / parts) + "; it is not written");
  }
}

/// Two columns of the same name could not be told apart.
void check_names_differ(const Result& result) {
  for (const FieldOn on : {FieldOn::vertex, FieldOn::face}) {
    std::vector<std::string> names;
    for (const Field& field : result.fields) {
      if (field.on == on) names.insert(names.end(), field.parts.begin(), field.parts.end());
    }
    std::sort(names.begin(), names.end());
    const auto twice = std::adjacent_find(names.begin(), names.end());
    if (twice != names.end()) throw UsageError("two fields are called '" + *twice + "'");
  }
}

}  // namespace

Field scalar_field(std::string name, FieldOn on, std::span<const double> values) {
  Field field{name, {}, on, values};
  field.parts.push_back(std::move(name));
  return field;
}

Field scalar_field(std::string name, FieldOn on, const Eigen::VectorXd& values) {
  return scalar_field(std::move(name), on,
                      std::span(values.data(), static_cast<std::size_t>(values.size())));
}

Field vector_field(std::string name, std::vector<std::string> parts, FieldOn on, Vec3View values) {
  if (parts.size() != 3) throw UsageError("field " + name + ": a vector field has three parts");
  return {std::move(name),
          std::move(parts),
          on,
          {values.data, static_cast<std::size_t>(3 * values.size)}};
}

std::string result_endings() {
  std::string all;
  for (const Ending& known : kEndings) all += (all.empty() ? "" : ", ") + std::string(known.text);
  return all;
}

void check_result_path(const std::string& path) {
  format_of(path);
  check_writable(path);
}

void check_result(const Result& result, const Context& context) {
  check_mesh(result.mesh, context);
  for (const Field& field : result.fields) check_field(field, result.mesh, context);
  check_names_differ(result);
}

std::vector<std::string> write_result(const std::string& path, const Result& result,
                                      const Context& context) {
  const Format format = format_of(path);
  check_result_path(path);
  check_result(result, context);

  std::vector<std::string> left_out;
  const auto leave_out_all = [&] {
    for (const Field& field : result.fields) left_out.push_back(field.name);
  };
  AtomicFile file(path);
  switch (format) {
    case Format::ply:
      detail::write_ply(file, result, context);
      break;
    case Format::vtp:
      detail::write_vtp(file, result, context);
      break;
    case Format::csv: {
      const FieldOn rows = result.fields.empty() ? FieldOn::vertex : result.fields.front().on;
      for (const Field& field : result.fields) {
        if (field.on != rows) left_out.push_back(field.name);
      }
      detail::write_csv(file, result, rows, context);
      break;
    }
    case Format::off:
      leave_out_all();
      detail::write_off(file, result, context);
      break;
    case Format::obj:
      leave_out_all();
      detail::write_obj(file, result, context);
      break;
    case Format::stl:
      leave_out_all();
      detail::write_stl(file, result, context);
      break;
    case Format::om:
      left_out = detail::write_om(file, result, context);
      break;
  }
  file.commit();
  return left_out;
}

namespace detail {

void write_in_chunks(AtomicFile& file, Index n, Index grain, const Encode& encode,
                     const Context& context) {
  const Index chunks = (n + grain - 1) / grain;
  const Index at_once = 4 * static_cast<Index>(thread_count(context));
  std::vector<std::string> buffers(static_cast<std::size_t>(std::min(chunks, at_once)));
  for (Index base = 0; base < chunks; base += at_once) {
    const Index count = std::min(at_once, chunks - base);
    parallel_for(context, count, 1, [&](Index first, Index last) {
      for (Index c = first; c < last; ++c) {
        std::string& buffer = buffers[static_cast<std::size_t>(c)];
        buffer.clear();
        encode((base + c) * grain, std::min(n, (base + c + 1) * grain), buffer);
      }
    });
    for (Index c = 0; c < count; ++c) {
      const std::string& buffer = buffers[static_cast<std::size_t>(c)];
      file.write(buffer.data(), buffer.size());
    }
    context.advance(std::min(n, (base + count) * grain) - base * grain);
  }
}

}  // namespace detail
}  // namespace dsc
