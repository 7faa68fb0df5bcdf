// What the pointer is on: the first face along a ray. Every face is looked at, most of them only by
// one distance: a million take some 10 ms, and there is nothing to build or to keep.

/** The largest distance of a face's corner from its first corner. */
function reachOf(model) {
  const {points, corners} = model;
  let most = 0;
  for (let f = 0; f < model.faces; ++f) {
    const first = model.first(f);
    const last = model.first(f + 1);
    const a = 3 * corners[first];
    for (let c = first + 1; c < last; ++c) {
      const b = 3 * corners[c];
      const x = points[b] - points[a];
      const y = points[b + 1] - points[a + 1];
      const z = points[b + 2] - points[a + 2];
      most = Math.max(most, x * x + y * y + z * z);
    }
  }
  return Math.sqrt(most);
}

/**
 * The distance along the ray o + t d to the triangle of vertices i, j, k (Möller and Trumbore), or
 * Infinity.
 */
function distanceToTriangle(points, o, d, i, j, k) {
  const ax = points[3 * i], ay = points[3 * i + 1], az = points[3 * i + 2];
  const ux = points[3 * j] - ax, uy = points[3 * j + 1] - ay, uz = points[3 * j + 2] - az;
  const vx = points[3 * k] - ax, vy = points[3 * k + 1] - ay, vz = points[3 * k + 2] - az;
  const px = d[1] * vz - d[2] * vy, py = d[2] * vx - d[0] * vz, pz = d[0] * vy - d[1] * vx;
  const determinant = ux * px + uy * py + uz * pz;
  if (determinant === 0) return Infinity;
  const sx = o[0] - ax, sy = o[1] - ay, sz = o[2] - az;
  const u = (sx * px + sy * py + sz * pz) / determinant;
  if (!(u >= 0 && u <= 1)) return Infinity;
  const qx = sy * uz - sz * uy, qy = sz * ux - sx * uz, qz = sx * uy - sy * ux;
  const v = (d[0] * qx + d[1] * qy + d[2] * qz) / determinant;
  if (!(v >= 0 && u + v <= 1)) return Infinity;
  const t = (vx * qx + vy * qy + vz * qz) / determinant;
  return t > 0 ? t : Infinity;
}

/**
 * The first face that the ray o + t d (d a unit vector, both in the coordinates of model.points)
 * meets on the near side of the plane `clip`, the point there and the nearest of its corners; null
 * where it meets none.
 */
function castRay(model, o, d, clip) {
  const {points, corners} = model;
  const reach2 = model.reach ** 2 * (1 + 1e-5);
  const isCut = (t) => clip &&
      clip.normal.reduce((sum, n, axis) => sum + n * (o[axis] + t * d[axis]), 0) > clip.offset;
  const [ox, oy, oz] = o;
  const [dx, dy, dz] = d;
  let least = Infinity;
  let face = -1;
  for (let f = 0; f < model.faces; ++f) {
    const first = model.first(f);
    const a = 3 * corners[first];
    const x = points[a] - ox, y = points[a + 1] - oy, z = points[a + 2] - oz;
    const along = x * dx + y * dy + z * dz;
    if (x * x + y * y + z * z - along * along > reach2) continue;
    const last = model.first(f + 1);
    for (let c = first + 1; c + 1 < last; ++c) {
      const t = distanceToTriangle(points, o, d, corners[first], corners[c], corners[c + 1]);
      if (t < least && !isCut(t)) {
        least = t;
        face = f;
      }
    }
  }
  if (face < 0) return null;
  const point = [ox + least * dx, oy + least * dy, oz + least * dz];
  return {face, point, vertex: nearestCorner(model, face, point)};
}

/** The vertex of a face that lies nearest to a point. */
function nearestCorner(model, face, point) {
  let nearest = -1;
  let least = Infinity;
  for (let c = model.first(face); c < model.first(face + 1); ++c) {
    const v = model.corners[c];
    const away = Math.hypot(...point.map((place, axis) => place - model.points[3 * v + axis]));
    if (away < least) {
      least = away;
      nearest = v;
    }
  }
  return nearest;
}
