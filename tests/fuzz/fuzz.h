/// \file
/// What is fuzzed: one function a reader, which libFuzzer calls with bytes that it makes up
/// (entry.cpp) and corpus_test.cpp with those of corpus/.
///
/// Each reads the bytes as a file of its format, checks that what it got is consistent and, where
/// there is a writer, that it reads back to the last bit. It throws a dsc::Error where the reader
/// refuses the bytes, and Broken where a promise does not hold; nothing else may happen.
#pragma once

#include "libdsc/base/context.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace dsc::fuzz {

/// A promise does not hold.
class Broken : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// One thread, watched by nobody.
inline const Context kContext{1, nullptr};

inline void require(bool holds, const char* promise) {
  if (!holds) throw Broken(promise);
}

void fuzz_vol(std::string_view bytes);
void fuzz_longvol(std::string_view bytes);
void fuzz_npy(std::string_view bytes);
void fuzz_raw(std::string_view bytes);  ///< ten bytes choose the layout (raw.cpp)
void fuzz_vox(std::string_view bytes);
void fuzz_vti(std::string_view bytes);
void fuzz_off(std::string_view bytes);
void fuzz_obj(std::string_view bytes);
void fuzz_ply(std::string_view bytes);
void fuzz_stl(std::string_view bytes);
void fuzz_om(std::string_view bytes);
void fuzz_expression(std::string_view bytes);  ///< of --function
void fuzz_shape(std::string_view bytes);       ///< of --shape

/// Calls it and judges the message of an error: about the file (or the text), short, and printable
/// whatever the bytes are. \return the message; empty where all was read. \throws Broken; whatever
/// else the target throws.
std::string outcome(void (*target)(std::string_view), std::string_view bytes);

}  // namespace dsc::fuzz
