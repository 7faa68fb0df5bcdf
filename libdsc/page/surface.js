// The surface on the graphics card. Every face has corners of its own, so that a value or a normal
// of a face is the same on all of them; polygons are fans from their first corner.

const kShading = {none: 0, faces: 1, estimated: 2};

/** What all views of the model share: positions, estimated normals and triangles. */
function sharedGeometry(model) {
  const corners = model.corners;
  const count = corners.length;
  const positions = new Float32Array(3 * count);
  for (let c = 0; c < count; ++c) {
    const from = 3 * corners[c];
    positions[3 * c] = model.points[from];
    positions[3 * c + 1] = model.points[from + 1];
    positions[3 * c + 2] = model.points[from + 2];
  }
  const facets = new Int16Array(2 * count);
  const triangles = new Uint32Array(3 * (count - 2 * model.faces));
  let to = 0;
  for (let f = 0; f < model.faces; ++f) {
    const first = model.first(f);
    const last = model.first(f + 1);
    for (let c = first + 1; c + 1 < last; ++c) {
      triangles[to++] = first;
      triangles[to++] = c;
      triangles[to++] = c + 1;
    }
    if (!model.normals) continue;
    for (let c = first; c < last; ++c) {
      facets[2 * c] = model.normals[2 * f];
      facets[2 * c + 1] = model.normals[2 * f + 1];
    }
  }
  return {
    position: new THREE.BufferAttribute(positions, 3),
    facet: new THREE.BufferAttribute(facets, 2, true),
    index: new THREE.BufferAttribute(triangles, 1),
  };
}

/** For each corner the place of its value in the range of the scalar. */
function placesOfCorners(model, scalar) {
  const places = new Float32Array(model.corners.length);
  if (!scalar) return places;
  const {corners, faces} = model;
  const {values, scale} = scalar;
  const {low, high} = scalar.range;
  const size = (high / 2 - low / 2) * 2 / scale;  // in the units of `values`
  const from = low / scale;
  const factor = size > 0 ? 1 / size : 0;
  const names = scalar.labels ? new Map(scalar.distinct.map((value, i) => [value, i])) : null;
  for (let f = 0; f < faces; ++f) {
    const first = model.first(f);
    const last = model.first(f + 1);
    if (scalar.on === 'face') {
      const value = values[f];
      const place = names ? names.get(value) : (value - from) * factor;
      places.fill(Number.isFinite(value) ? place : kInfinitePlace, first, last);
      continue;
    }
    let finite = true;
    for (let c = first; c < last; ++c) {
      const value = values[corners[c]];
      places[c] = (value - from) * factor;
      finite = finite && Number.isFinite(value);
    }
    if (!finite) places.fill(kInfinitePlace, first, last);
  }
  return places;
}

/** The shared geometry with further attributes, drawn by the program of shaders.js. */
function sceneOf(shared, attributes, uniforms, further = {}) {
  const material = new THREE.ShaderMaterial({
    uniforms,
    vertexShader: kVertexShader,
    fragmentShader: kFragmentShader,
    side: THREE.DoubleSide,
    extensions: {derivatives: true},
    ...further,
  });
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', shared.position);
  geometry.setAttribute('facet', shared.facet);
  geometry.setIndex(shared.index);
  for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
  geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(), Math.sqrt(3));
  const mesh = new THREE.Mesh(geometry, material);
  mesh.frustumCulled = false;
  const scene = new THREE.Scene();
  scene.add(mesh);
  return scene;
}

/** One view's copy of the surface: the shared geometry under a scalar's colours. */
class ColoredSurface {
  constructor(model, shared) {
    this.model = model;
    this.scalar = undefined;
    this.uniforms = {
      map: {value: null},
      colouring: {value: 0},
      shading: {value: 0},
      window: {value: new THREE.Vector2(0, 1)},
      lines: {value: new THREE.Vector2(0, 0)},
      lineColor: {value: new THREE.Vector4(0, 0, 0, 0.55)},
      plainColor: {value: new THREE.Color(0.80, 0.79, 0.76)},
      infiniteColor: {value: new THREE.Color(0.55, 0.55, 0.55)},
      clip: {value: new THREE.Vector4(0, 0, 0, 1)},
      cutShade: {value: 1},
    };
    this.values = new THREE.BufferAttribute(new Float32Array(model.corners.length), 1);
    this.scene = sceneOf(shared, {value: this.values}, this.uniforms);
  }

  /** Colours by a scalar, or plainly where it is null. */
  show(scalar) {
    if (scalar === this.scalar) return;
    this.scalar = scalar;
    this.values.array = placesOfCorners(this.model, scalar);
    this.values.needsUpdate = true;
    this.uniforms.colouring.value = !scalar ? 0 : scalar.labels ? 2 : 1;
  }

  /** The map from `low` to `high`, isolines at the multiples of `step` (0: none). */
  colourBy(map, low, high, step) {
    if (!this.scalar) return;
    const {low: least, high: largest} = this.scalar.range;
    const size = largest - least || 1;
    this.uniforms.map.value = map.texture;
    this.uniforms.window.value.set((low - least) / size, (high - least) / size);
    const smooth = this.scalar.on === 'vertex' && step > 0 && largest > least;
    // Only the fraction of the offset counts, and a small number keeps its digits.
    const offset = smooth ? least / step - Math.floor(least / step) : 0;
    this.uniforms.lines.value.set(smooth ? size / step : 0, offset);
  }

  shadeBy(name) {
    this.uniforms.shading.value = kShading[name];
  }

  /** Cuts what lies beyond a plane {normal, offset} of model.points; null: nothing. */
  clipBy(plane) {
    if (plane) this.uniforms.clip.value.set(...plane.normal, plane.offset);
    else this.uniforms.clip.value.set(0, 0, 0, 1);
    this.uniforms.cutShade.value = plane ? 0.72 : 1;
  }
}
