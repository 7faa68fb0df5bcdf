/// \file
/// A limit that always has so many bytes left, whatever is asked for.
#pragma once

#include "libdsc/base/context.h"

#include <string_view>

namespace dsc::test {

class MemoryLeft final : public MemoryLimit {
 public:
  explicit MemoryLeft(Index bytes) : bytes_(bytes) {}
  void need(std::string_view, Index) const override {}
  Index left() const override { return bytes_; }

 private:
  Index bytes_;
};

}  // namespace dsc::test
