// One or two panes on one canvas, with linked cameras. Drawn when something changed, and only then.

class View {
  /** `inset` tells how many pixels at the right and at the bottom the panel covers, {right, bottom}. */
  constructor(canvas, marks, model, inset) {
    Object.assign(this, {canvas, marks, model, inset});
    this.footer = 0;  // the height of the captions, which no surface may run into
    // Without a graphics card, smooth edges take three times as long; faces by the million have few.
    const antialias = model.faces < 300000;
    this.renderer = new THREE.WebGLRenderer({canvas, antialias});
    this.renderer.autoClear = false;
    // Images beside the canvas have no smooth edges.
    this.pairs = !antialias && canPair(this.renderer);
    const shared = sharedGeometry(model);
    this.panes = [new ColoredSurface(model, shared)];
    this.makeSecond = () => {
      this.panes.push(new ColoredSurface(model, shared));
      if (this.pairs) this.pair = new Pair(this.renderer, shared, this.panes);
    };
    this.plane = null;
    this.picked = null;
    this.waiting = 0;
    this.orbit = new Orbit(canvas, model.points, () => this.request());
    window.addEventListener('resize', () => this.request());
    canvas.addEventListener('webglcontextrestored', () => this.request());
  }

  /** The second pane is made when it is first wanted: it takes 4 bytes a corner. */
  setPaneCount(count) {
    if (count === 2 && this.panes.length < 2) this.makeSecond();
    this.paneCount = count;
  }

  /** The panes' rectangles in CSS pixels from the top left; below each is room for its caption. */
  rectangles() {
    return this.tiles().map((r) => ({...r, height: Math.max(1, r.height - this.footer)}));
  }

  /** The panes with their captions. */
  tiles() {
    const {right, bottom} = this.inset();
    const width = Math.max(1, this.canvas.clientWidth - right);
    const height = Math.max(1, this.canvas.clientHeight - bottom);
    if (this.paneCount !== 2) return [{x: 0, y: 0, width, height}];
    if (width < 0.8 * height) {
      return [0, 1].map((i) => ({x: 0, y: i * height / 2, width, height: height / 2}));
    }
    return [0, 1].map((i) => ({x: i * width / 2, y: 0, width: width / 2, height}));
  }

  request() {
    if (this.waiting) return;
    this.waiting = requestAnimationFrame(() => this.draw());
  }

  draw() {
    const {canvas, renderer} = this;
    if (this.arrange) this.arrange();
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    const ratio = Math.min(window.devicePixelRatio || 1, 2);
    if (ratio !== renderer.getPixelRatio()) renderer.setPixelRatio(ratio);
    const size = renderer.getSize(new THREE.Vector2());
    if (size.x !== width || size.y !== height) renderer.setSize(width, height, false);
    renderer.setScissorTest(false);
    renderer.setClearColor(getComputedStyle(document.body).backgroundColor);
    renderer.clear();
    renderer.setScissorTest(true);
    const places = this.rectangles().map((r) => ({...r, y: height - r.y - r.height}));
    const camera = this.orbit.cameraFor(places[0].width, places[0].height);
    if (places.length === 2 && this.pairs) {
      this.pair.draw(places, camera);
    } else {
      places.forEach((place, i) => {
        renderer.setViewport(place.x, place.y, place.width, place.height);
        renderer.setScissor(place.x, place.y, place.width, place.height);
        renderer.render(this.panes[i].scene, camera);
      });
    }
    this.drawMarks();
    // Whatever asked for a picture has it: at first the page would draw itself twice.
    cancelAnimationFrame(this.waiting);
    this.waiting = 0;
  }

  /** The place on the canvas of a point of model.points, in a pane. */
  project(point, r) {
    const p = new THREE.Vector3(...point).project(this.orbit.cameraFor(r.width, r.height));
    return [r.x + (p.x + 1) / 2 * r.width, r.y + (1 - p.y) / 2 * r.height];
  }

  /** What is picked, over the canvas: the surface need not be drawn again for it. */
  drawMarks() {
    this.marks.replaceChildren();
    if (!this.picked) return;
    const {points, corners} = this.model;
    const pointOf = (v) => points.subarray(3 * v, 3 * v + 3);
    const add = (parent, name, attributes) => {
      const element = document.createElementNS('http://www.w3.org/2000/svg', name);
      for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
      parent.append(element);
      return element;
    };
    for (const r of this.rectangles()) {
      const {x, y, width, height} = r;  // a drawing of its own keeps within them
      const pane = add(this.marks, 'svg', {x, y, width, height, viewBox: [x, y, width, height].join(' ')});
      if (this.picked.face >= 0) {
        const [first, last] = [this.picked.face, this.picked.face + 1].map((f) => this.model.first(f));
        const outline = [...corners.subarray(first, last)].map((v) => this.project(pointOf(v), r));
        add(pane, 'polygon', {points: outline.map((p) => p.join()).join(' ')});
      }
      if (this.picked.vertex >= 0) {
        const [cx, cy] = this.project(pointOf(this.picked.vertex), r);
        add(pane, 'circle', {cx, cy, r: 5});
      }
    }
  }

  /** The face, its point and its vertex under a place of the canvas, or null. */
  pick(x, y) {
    const r = this.rectangles().find(
        (q) => x >= q.x && x < q.x + q.width && y >= q.y && y < q.y + q.height);
    if (!r) return null;
    const camera = this.orbit.cameraFor(r.width, r.height);
    const [right, up] = [(x - r.x) / r.width * 2 - 1, 1 - (y - r.y) / r.height * 2];
    const direction = new THREE.Vector3(right, up, 0.5).unproject(camera).sub(camera.position).normalize();
    return castRay(this.model, camera.position.toArray(), direction.toArray(), this.plane);
  }

  /** The colour on the canvas at a place, as bytes; draws for it. */
  pixel(x, y) {
    this.draw();
    return this.seen(x, y);
  }

  /** The same of the picture that was drawn last; not to be asked for later than that. */
  seen(x, y) {
    const gl = this.renderer.getContext();
    const ratio = this.renderer.getPixelRatio();
    const bytes = new Uint8Array(4);
    gl.readPixels(Math.floor(x * ratio), gl.drawingBufferHeight - 1 - Math.floor(y * ratio), 1, 1,
                  gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return [...bytes.subarray(0, 3)];
  }
}
