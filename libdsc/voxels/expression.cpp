#include "libdsc/voxels/expression.h"

#include "libdsc/base/parallel.h"
#include "libdsc/voxels/shape_rows.h"

#include <muParser.h>

#include <cmath>
#include <mutex>
#include <utility>
#include <vector>

namespace dsc {
namespace {

/// muParser reads numbers in one locale for all parsers, whose tables libstdc++ makes for the first
/// number, and readers take no lock: that one is read before two threads could.
void make_locale_ready() {
  static const double first = [] {
    mu::Parser parser;
    parser.SetExpr("0.5");
    return parser.Eval();
  }();
  (void)first;
}

}  // namespace

/// A compiled parser and the variables that it reads.
struct Expression::Evaluator::Machine {
  explicit Machine(const std::string& text) {
    make_locale_ready();
    parser.DefineVar("x", &x);
    parser.DefineVar("y", &y);
    parser.DefineVar("z", &z);
    parser.DefineConst("pi", 3.14159265358979323846);
    parser.SetExpr(text);
    (void)parser.Eval();  // compiles; the value at the origin may be anything
  }
  Machine(const Machine&) = delete;
  Machine& operator=(const Machine&) = delete;

  double x = 0;
  double y = 0;
  double z = 0;
  mu::Parser parser;
};

struct Expression::Pool {
  std::string text;
  std::mutex mutex;
  std::vector<std::unique_ptr<Evaluator::Machine>> idle;
};

namespace {

[[noreturn]] void reject(const std::string& text, std::size_t position, const std::string& why) {
  throw UsageError("expression '" + text + "', character " + std::to_string(position + 1) + ": " +
                   why + "; write a function of x, y, z such as 'x^2 + sin(pi*y)'");
}

/// muParser would let "x = 1" overwrite the variable.
void reject_assignment(const std::string& text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool after = i + 1 < text.size() && text[i + 1] == '=';
    if (after) {
      ++i;
      continue;
    }
    const char before = i > 0 ? text[i - 1] : ' ';
    if (before != '<' && before != '>' && before != '!') {
      reject(text, i, "'=' assigns; compare with '=='");
    }
  }
}

}  // namespace

Expression::Expression(const std::string& text) : pool_(std::make_unique<Pool>()) {
  if (text.find_first_not_of(" \t") == std::string::npos) reject(text, 0, "it is empty");
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 32 || c > 126) reject(text, i, "only printable ASCII characters are allowed");
    if (c == '"') reject(text, i, "strings are not allowed");
  }
  reject_assignment(text);
  pool_->text = text;
  try {
    auto machine = std::make_unique<Evaluator::Machine>(text);
    if (machine->parser.GetNumResults() != 1) {
      reject(text, text.find(','), "a comma makes several values, one is wanted");
    }
    pool_->idle.push_back(std::move(machine));
  } catch (const mu::ParserError& e) {
    reject(text, static_cast<std::size_t>(std::max(0, static_cast<int>(e.GetPos()))), e.GetMsg());
  }
}

Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;
Expression::~Expression() = default;

const std::string& Expression::text() const { return pool_->text; }

Expression::Evaluator::Evaluator(const Expression& expression) : expression_(expression) {
  Pool& pool = *expression.pool_;
  const std::lock_guard lock(pool.mutex);
  if (pool.idle.empty()) {
    machine_ = std::make_unique<Machine>(pool.text);
  } else {
    machine_ = std::move(pool.idle.back());
    pool.idle.pop_back();
  }
}

Expression::Evaluator::~Evaluator() {
  Pool& pool = *expression_.pool_;
  const std::lock_guard lock(pool.mutex);
  try {
    pool.idle.push_back(std::move(machine_));
  } catch (...) {  // no memory to keep it: it is made anew when wanted
  }
}

double Expression::Evaluator::operator()(const Vec3& p) {
  machine_->x = p.x();
  machine_->y = p.y();
  machine_->z = p.z();
  double value = 0;
  try {
    value = machine_->parser.Eval();
  } catch (const mu::ParserError& e) {
    throw InputError("expression '" + expression_.text() + "' at (" + text_of(p.x()) + ", " +
                     text_of(p.y()) + ", " + text_of(p.z()) + "): " + e.GetMsg());
  }
  if (!std::isfinite(value)) {
    throw InputError("expression '" + expression_.text() + "' is " + text_of(value) + " at (" +
                     text_of(p.x()) + ", " + text_of(p.y()) + ", " + text_of(p.z()) +
                     "); it must be finite at every point where it is used");
  }
  return value;
}

double Expression::operator()(const Vec3& p) const { return Evaluator(*this)(p); }

Eigen::VectorXd Expression::operator()(Vec3View points, const Context& context) const {
  context.need("evaluate", 8 * points.size);
  Eigen::VectorXd values(points.size);
  context.begin("evaluate", points.size);
  parallel_for(context, points.size, 4096, [&](Index first, Index last) {
    Evaluator evaluate(*this);
    for (Index i = first; i < last; ++i) values[i] = evaluate(points[i]);
    context.advance(last - first);
  });
  return values;
}

}  // namespace dsc
