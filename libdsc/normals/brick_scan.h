/// \file
/// \internal
/// Moments of balls centred on many surfels, by bricks: for large balls far less work
/// than their rows.
#pragma once

#include "libdsc/base/context.h"
#include "libdsc/normals/ball_moments.h"
#include "libdsc/surface/surfel.h"

#include <functional>
#include <span>

namespace dsc {

/// Whether the machine and the radius allow brick_scan().
bool bricks_serve(const Ball& ball);

/// Whether it also takes less time than a BallScanner would, and at most about 100 bytes a surfel.
bool bricks_pay(const Ball& ball, std::span<const Surfel> surfels);

/// Calls visit(i, moments) for the ball at every surfel's centre, each once, from many threads in
/// any order; the same integers as BallScanner::plain. The ball has the volume's spacing.
/// Precondition: bricks_serve(ball).
void brick_scan(const BinaryVolume& volume, const Ball& ball, std::span<const Surfel> surfels,
                const std::function<void(Index i, const BallMoments& moments)>& visit,
                const Context& context = {});

}  // namespace dsc
