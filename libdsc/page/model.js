// The surface and its fields as the page holds them.

/** A scalar that the page can show: a field, a part of a vector field or its length. */
class Scalar {
  /**
   * `compute` gives the values, one a vertex or a face; it is called once, when they are needed.
   * They are multiplied by `scale`, which keeps the bits of floats.
   */
  constructor(name, on, labels, scale, compute) {
    Object.assign(this, {name, on, labels, scale, compute});
    this.kept = null;
  }

  get values() {
    if (!this.kept) this.kept = this.compute();
    return this.kept;
  }

  at(i) {
    return this.values[i] * this.scale;
  }

  /** The least and the largest finite value, and whether there are others. */
  get range() {
    if (this.keptRange) return this.keptRange;
    let low = Infinity;
    let high = -Infinity;
    let infinite = false;
    for (const value of this.values) {
      if (!Number.isFinite(value)) {
        infinite = true;
        continue;
      }
      if (value < low) low = value;
      if (value > high) high = value;
    }
    const none = low > high;  // no value is finite
    if (none) low = high = 0;
    this.keptRange = {low: low * this.scale, high: high * this.scale, infinite, none};
    return this.keptRange;
  }

  /** Limits between which lie all but the hundredth lowest and highest of the finite values. */
  get middle() {
    const values = this.values;
    const step = Math.max(1, Math.floor(values.length / 50000));
    const sample = [];
    for (let i = 0; i < values.length; i += step) {
      if (Number.isFinite(values[i])) sample.push(values[i]);
    }
    if (sample.length === 0) return this.range;
    const sorted = Float32Array.from(sample).sort();
    const last = sorted.length - 1;
    const low = sorted[Math.round(0.01 * last)] * this.scale;
    const high = sorted[Math.round(0.99 * last)] * this.scale;
    return low < high ? {low, high} : this.range;
  }

  /** The values that occur, ascending: of labels. */
  get distinct() {
    if (!this.keptDistinct) this.keptDistinct = [...new Set(this.values)].sort((a, b) => a - b);
    return this.keptDistinct;
  }
}

/** The scalars of one field of the manifest; `values` are its floats, interleaved. */
function scalarsOf(field, values) {
  const scale = 2 ** field.exponent;
  const n = field.parts.length;
  if (n === 1) return [new Scalar(field.name, field.on, field.labels, scale, () => values)];
  const part = (c) => () => {
    const own = new Float32Array(values.length / n);
    for (let i = 0; i < own.length; ++i) own[i] = values[i * n + c];
    return own;
  };
  const length = () => {
    const own = new Float32Array(values.length / n);
    for (let i = 0; i < own.length; ++i) own[i] = Math.hypot(...values.subarray(i * n, i * n + n));
    return own;
  };
  return [
    new Scalar(`|${field.name}|`, field.on, false, scale, length),
    ...field.parts.map((name, c) => new Scalar(name, field.on, false, scale, part(c))),
  ];
}

class Model {
  /** `blocks` has the integers of each block by its name. */
  constructor(manifest, blocks) {
    this.manifest = manifest;
    this.title = manifest.title;
    this.vertices = manifest.vertices;
    this.faces = manifest.faces;
    this.sides = manifest.sides;
    this.corners = blocks.corners;
    this.normals = blocks.normals || null;
    this.places = manifest.lattice ? blocks.positions : floatsOfIntegers(blocks.positions);
    if (this.sides === 0) this.offsets = offsetsOf(blocks.sizes);
    this.scalars = manifest.fields.flatMap(
        (field, i) => scalarsOf(field, floatsOfIntegers(blocks[`field${i}`])));
    this.fitToUnit();
  }

  /** The first corner of a face; of the face after the last, the number of corners. */
  first(face) {
    return this.sides > 0 ? this.sides * face : this.offsets[face];
  }

  /** World coordinate of a vertex along an axis. */
  coordinate(vertex, axis) {
    return this.manifest.origin[axis] + this.manifest.step[axis] * this.places[3 * vertex + axis];
  }

  position(vertex) {
    return [0, 1, 2].map((axis) => this.coordinate(vertex, axis));
  }

  /** The world position of a point in the coordinates of `points`. */
  worldOf(point) {
    return [0, 1, 2].map((axis) => this.centre[axis] + this.radius * point[axis]);
  }

  /** `points`: the vertices moved and scaled into the box from −1 to 1, whatever their units. */
  fitToUnit() {
    const {origin, step} = this.manifest;
    const places = this.places;
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < places.length; i += 3) {
      for (let axis = 0; axis < 3; ++axis) {
        const place = places[i + axis] * step[axis];
        if (place < low[axis]) low[axis] = place;
        if (place > high[axis]) high[axis] = place;
      }
    }
    this.radius = Math.max(...[0, 1, 2].map((axis) => high[axis] / 2 - low[axis] / 2)) || 1;
    const middle = [0, 1, 2].map((axis) => low[axis] / 2 + high[axis] / 2);
    this.centre = middle.map((place, axis) => origin[axis] + place);
    this.half = [0, 1, 2].map((axis) => (high[axis] / 2 - low[axis] / 2) / this.radius);
    this.points = new Float32Array(places.length);
    for (let i = 0; i < places.length; ++i) {
      const axis = i % 3;
      this.points[i] = (places[i] * step[axis] - middle[axis]) / this.radius;
    }
  }
}

function offsetsOf(sizes) {
  const offsets = new Int32Array(sizes.length + 1);
  for (let f = 0; f < sizes.length; ++f) offsets[f + 1] = offsets[f] + sizes[f];
  return offsets;
}

/** Reads the blocks of this page; `progress` is told the done share, 0 to 1. */
async function readModel(manifest, progress) {
  const components = {positions: 3, corners: manifest.sides || 1, sizes: 1, normals: 2};
  manifest.fields.forEach((field, i) => { components[`field${i}`] = field.parts.length; });
  const names = Object.keys(components).filter((name) => document.getElementById(name));
  const blocks = {};
  let done = 0;
  for (const name of names) {
    const element = document.getElementById(name);
    const bytes = bytesOfBase64(element.textContent);
    element.remove();
    blocks[name] = integersOfPlanes(await inflated(bytes), components[name]);
    progress(++done / names.length);
  }
  return new Model(manifest, blocks);
}
