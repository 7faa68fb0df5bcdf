// The camera: it turns around a point by pointer, wheel and keys.

const kFieldOfView = 28;  // degrees
const kTurnPerPixel = 0.007;

class Orbit {
  /** `changed` is called after every move. The first view shows all of the `points`. */
  constructor(canvas, points, changed) {
    Object.assign(this, {points, changed});
    this.camera = new THREE.PerspectiveCamera(kFieldOfView, 1, 0.01, 100);
    this.pointers = new Map();
    this.listen(canvas);
    this.reset();
  }

  /** The first view, from in front and above, z up. */
  reset() {
    this.target = new THREE.Vector3();
    const eye = new THREE.Matrix4().lookAt(
        new THREE.Vector3(0.55, -1, 0.5), new THREE.Vector3(), new THREE.Vector3(0, 0, 1));
    this.rotation = new THREE.Quaternion().setFromRotationMatrix(eye);
    const slope = Math.tan(kFieldOfView / 2 * Math.PI / 180);
    this.distance = Math.max(1.38 / slope, 1.04 * this.distanceToSeeAll(slope));
    this.changed();
  }

  /** A square view shows all points from there, and so does any other; `slope` is half its height at 1. */
  distanceToSeeAll(slope) {
    const {elements: e} = new THREE.Matrix4().makeRotationFromQuaternion(this.rotation);
    const points = this.points;
    let distance = 0;
    for (let i = 0; i < points.length; i += 3) {
      const along = (axis) =>  // of the screen: right, up, to the eye
          e[4 * axis] * points[i] + e[4 * axis + 1] * points[i + 1] + e[4 * axis + 2] * points[i + 2];
      const aside = Math.max(Math.abs(along(0)), Math.abs(along(1)));
      distance = Math.max(distance, aside / slope + Math.max(0, along(2)));
    }
    return distance;
  }

  /** Around the axes of the screen, radians. */
  turn(right, down) {
    const around = (x, y, angle) =>
        new THREE.Quaternion().setFromAxisAngle(new THREE.Vector3(x, y, 0), angle);
    this.rotation.multiply(around(0, 1, -right)).multiply(around(1, 0, -down)).normalize();
    this.changed();
  }

  /** In pixels of a view that is `height` high. */
  pan(x, y, height) {
    const unit = 2 * this.distance * Math.tan(kFieldOfView / 2 * Math.PI / 180) / height;
    this.target.add(new THREE.Vector3(-x * unit, y * unit, 0).applyQuaternion(this.rotation));
    this.changed();
  }

  zoom(factor) {
    this.distance = Math.min(100, Math.max(1e-4, this.distance * factor));
    this.changed();
  }

  /** The camera for a view of this shape: a narrow one shows the surface's width, not its height. */
  cameraFor(width, height) {
    const camera = this.camera;
    const distance = this.distance * Math.max(1, height / width);
    camera.aspect = width / height;
    camera.quaternion.copy(this.rotation);
    camera.position.set(0, 0, distance).applyQuaternion(this.rotation).add(this.target);
    camera.far = distance + this.target.length() + 2;
    camera.near = Math.max(distance - this.target.length() - 2, 0.002 * distance);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }

  listen(canvas) {
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      this.pointers.set(event.pointerId, {x: event.clientX, y: event.clientY});
    });
    canvas.addEventListener('pointermove', (event) => this.drag(event, canvas.clientHeight));
    for (const end of ['pointerup', 'pointercancel']) {
      canvas.addEventListener(end, (event) => this.pointers.delete(event.pointerId));
    }
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      const lines = event.deltaMode === 1 ? 33 : 1;
      this.zoom(Math.exp(0.0012 * lines * event.deltaY));
    }, {passive: false});
    canvas.addEventListener('keydown', (event) => this.key(event));
  }

  drag(event, height) {
    const last = this.pointers.get(event.pointerId);
    if (!last) return;
    const [x, y] = [event.clientX - last.x, event.clientY - last.y];
    const others = [...this.pointers.entries()].filter(([id]) => id !== event.pointerId);
    if (others.length > 0) {  // two fingers pinch and pan
      const other = others[0][1];
      const before = Math.hypot(last.x - other.x, last.y - other.y);
      const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
      if (before > 0 && after > 0) this.zoom(before / after);
      this.pan(x / 2, y / 2, height);
    } else if (event.buttons & 2 || event.shiftKey) {
      this.pan(x, y, height);
    } else {
      this.turn(kTurnPerPixel * x, kTurnPerPixel * y);
    }
    Object.assign(last, {x: event.clientX, y: event.clientY});
  }

  key(event) {
    const step = 0.1;
    const moves = {
      ArrowLeft: () => this.turn(-step, 0),
      ArrowRight: () => this.turn(step, 0),
      ArrowUp: () => this.turn(0, -step),
      ArrowDown: () => this.turn(0, step),
      '+': () => this.zoom(1 / 1.15),
      '=': () => this.zoom(1 / 1.15),
      '-': () => this.zoom(1.15),
      0: () => this.reset(),
    };
    if (!moves[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    moves[event.key]();
  }
}
