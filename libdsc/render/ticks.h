/// \file
/// \internal
/// Round numbers along a range of values.
#pragma once

#include <string>
#include <vector>

namespace dsc::render {

/// The smallest of 1, 2, 5 times a power of ten of which at most `count` lie between consecutive
/// ends: (high - low) / step <= count. 0 where high <= low or count < 1.
double round_step(double low, double high, int count);

/// The multiples of `step` from low to high, ends included; none for step 0.
std::vector<double> multiples(double low, double high, double step);

/// Numbers for people, all with as many digits as tell multiples of `step` apart; in powers of ten
/// where the largest is below 0.001 or from 100 000.
std::vector<std::string> tick_texts(const std::vector<double>& values, double step);

}  // namespace dsc::render
