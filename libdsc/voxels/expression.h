/// \file
/// A real function of x, y, z given as text, evaluated by muParser.
///
/// Syntax: numbers, x, y, z, pi, + - * / ^, comparisons, && ||, COND ? A : B, and muParser's
/// functions (sin, cos, tan, exp, ln, log10, sqrt, abs, min, max, sign, rint, …). Assignments are
/// rejected. Safe to use from several threads: each borrows a parser of its own.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/base/types.h"

#include <Eigen/Core>

#include <memory>
#include <string>

namespace dsc {

/// A function parsed once; the operators below evaluate it.
class Expression {
 public:
  /// \throws UsageError with the position of the fault, counted from 1, where `text` is no
  /// expression in x, y, z.
  explicit Expression(const std::string& text);
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;
  ~Expression();

  /// As it was given.
  const std::string& text() const;

  /// The value at p. \throws InputError naming the point where it is not finite.
  double operator()(const Vec3& p) const;

  /// The values at `points`, in parallel. \throws InputError naming the first point whose value is
  /// not finite.
  Eigen::VectorXd operator()(Vec3View points, const Context& context = {}) const;

  /// A parser borrowed for many evaluations on one thread; cheaper than operator() in a loop. The
  /// expression must outlive it.
  class Evaluator {
   public:
    /// Borrows the parser; it goes back at the end of this object.
    explicit Evaluator(const Expression& expression);
    Evaluator(const Evaluator&) = delete;
    Evaluator& operator=(const Evaluator&) = delete;
    ~Evaluator();
    /// As Expression::operator().
    double operator()(const Vec3& p);

   private:
    const Expression& expression_;
    struct Machine;
    friend class Expression;
    std::unique_ptr<Machine> machine_;
  };

 private:
  struct Pool;
  std::unique_ptr<Pool> pool_;
};

}  // namespace dsc
