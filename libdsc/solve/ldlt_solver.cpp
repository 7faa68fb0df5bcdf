#include "libdsc/solve/ldlt_solver.h"

#include "libdsc/base/error.h"
#include "libdsc/solve/ldlt_factor.h"

#include <utility>

namespace dsc {
namespace {

class LdltSolver final : public SpdSolver {
 public:
  LdltSolver(SparseMatrix&& A, const SolverOptions& options, const Context& context)
      : SpdSolver(std::move(A), options),
        factor_((context.check(), matrix()), FillOrder::nested_dissection, context) {
    context.check();
  }

  WideVector solve_wide(const WideVector& b, const Context&) const override {
    if (b.size() != size()) throw UsageError("LDLT: the right-hand side has a wrong length");
    WideVector x = b;
    factor_.solve_in_place(x);
    return x;
  }

 protected:
  Correction correct(const Eigen::VectorXd& r, double, const Context&) const override {
    return {factor_.solve(r), 0};
  }

 private:
  LdltFactor factor_;
};

}  // namespace

std::unique_ptr<SpdSolver> make_ldlt_solver(SparseMatrix A, const SolverOptions& options,
                                            const Context& context) {
  return std::make_unique<LdltSolver>(std::move(A), options, context);
}

}  // namespace dsc
