/// \file
/// A vector of doubles whose exponents do not run out.
///
/// Heat decays like exp(-distance / sqrt(t)) and leaves double's range some 700 sqrt(t) from its
/// source. Entry i here is mantissa[i] * 2^(256 exponent[i]), a range of 10^(10^11). Entries of
/// similar size share an exponent, so nearly all arithmetic is that of doubles.
#pragma once

#include "libdsc/base/types.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace dsc {

/// One such number. Zero is mantissa 0, whatever the exponent. Normalised: |mantissa| in
/// [2^-128, 2^128).
struct Wide {
  static constexpr double kBase = 0x1p256;  ///< what an exponent of 1 stands for
  static constexpr double kLow = 0x1p-128;  ///< the least normalised |mantissa|
  static constexpr double kHigh = 0x1p128;  ///< all are below

  double mantissa = 0;        ///< signed
  std::int32_t exponent = 0;  ///< of kBase

  /// The same number, normalised; the mantissa must be finite.
  void normalise() {
    if (mantissa == 0) return;
    while (std::abs(mantissa) < kLow) {
      mantissa *= kBase;
      --exponent;
    }
    while (std::abs(mantissa) >= kHigh) {
      mantissa /= kBase;
      ++exponent;
    }
  }

  /// The natural logarithm of a positive number.
  double log() const { return std::log(mantissa) + 256. * 0.693147180559945309417 * exponent; }

  /// Adds m * 2^(256 e), m finite. Rounds as a sum of doubles does.
  void add(double m, std::int32_t e) {
    if (std::abs(m) < kLow) {
      if (m == 0) return;
      do {
        m *= kBase;
        --e;
      } while (std::abs(m) < kLow);
    }
    if (e == exponent) {
      mantissa += m;
    } else if (mantissa == 0) {
      mantissa = m;
      exponent = e;
    } else if (e > exponent) {  // what is two steps smaller is below the rounding
      mantissa = (e - exponent == 1 ? mantissa / kBase : 0) + m;
      exponent = e;
    } else if (exponent - e == 1) {
      mantissa += m / kBase;
    }
  }
};

/// n of them.
class WideVector {
 public:
  WideVector() = default;
  /// n zeros.
  explicit WideVector(Index n)
      : mantissa_(Eigen::VectorXd::Zero(n)), exponent_(static_cast<std::size_t>(n), 0) {}

  /// n.
  Index size() const { return mantissa_.size(); }
  /// Entry i.
  Wide operator[](Index i) const { return {mantissa_[i], exponent_[static_cast<std::size_t>(i)]}; }
  /// Entry i becomes w.
  void set(Index i, const Wide& w) {
    mantissa_[i] = w.mantissa;
    exponent_[static_cast<std::size_t>(i)] = w.exponent;
  }
  /// Adds m * 2^(256 e) to entry i; see Wide::add().
  void add(Index i, double m, std::int32_t e) {
    Wide w = (*this)[i];
    w.add(m, e);
    set(i, w);
  }
  /// Of entry i.
  /// @{
  double mantissa(Index i) const { return mantissa_[i]; }
  std::int32_t exponent(Index i) const { return exponent_[static_cast<std::size_t>(i)]; }
  /// @}

  /// Entry i divided by 2^(256 e): for entries of a neighbourhood relative to its largest.
  double relative_to(Index i, std::int32_t e) const {
    const std::int64_t shift = 256 * (static_cast<std::int64_t>(exponent(i)) - e);
    return shift < -2000 ? 0. : std::ldexp(mantissa_[i], static_cast<int>(shift));
  }
  /// The natural logarithm of entry i > 0.
  double log(Index i) const { return (*this)[i].log(); }

 private:
  Eigen::VectorXd mantissa_;
  std::vector<std::int32_t> exponent_;
};

}  // namespace dsc
