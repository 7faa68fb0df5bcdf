/// \file
/// (internal) Tables of the vector path of BallScanner.
#pragma once

namespace dsc {

class BallMasks {};

}  // namespace dsc
