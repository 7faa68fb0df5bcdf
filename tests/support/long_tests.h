/// \file
/// How much a test does: a part in every run of the tests, all of it where DSC_LONG_TESTS is set.
#pragma once

#include <cstdlib>

namespace dsc::testing {

inline bool long_tests() { return std::getenv("DSC_LONG_TESTS") != nullptr; }

template <class Count>
Count usually_or_long(Count usually, Count in_long_runs) {
  return long_tests() ? in_long_runs : usually;
}

}  // namespace dsc::testing
