// With #selftest in its address the page examines itself and leaves what it found, as JSON, in the
// element `selftest`. Errors of any kind since its first line are among it.

const selfTestErrors = [];
if (location.hash.includes('selftest')) {
  const keep = console.error;
  console.error = (...parts) => {
    selfTestErrors.push(parts.map(String).join(' '));
    keep.apply(console, parts);
  };
  window.addEventListener('error', (event) => selfTestErrors.push(event.message));
  window.addEventListener('unhandledrejection', (event) => selfTestErrors.push(String(event.reason)));
}

/** The colour, without shading and under each kind of it, and the reading at the middle of each pane. */
function paneReport(model, view, panel, r) {
  const [x, y] = [Math.floor(r.x + r.width / 2) + 0.5, Math.floor(r.y + r.height / 2) + 0.5];
  const shading = byId('shading');
  const before = shading.value;
  const colours = {};
  for (const option of shading.options) {
    shading.value = option.value;
    panel.update();
    colours[option.value] = view.pixel(x, y);
  }
  shading.value = before;
  panel.update();
  panel.pickAt(x, y);
  const picked = view.picked;
  if (!picked) return {colours, picked: null};
  const reading = [...byId('reading').rows].map((row) => [...row.cells].map((cell) => cell.textContent));
  return {
    colours,
    pickMilliseconds: panel.pickTime,
    picked: {
      face: picked.face,
      vertex: picked.vertex,
      point: model.worldOf(picked.point),
      position: model.position(picked.vertex),
      values: Object.fromEntries(model.scalars.map(
          (s) => [s.name, s.at(s.on === 'vertex' ? picked.vertex : picked.face)])),
    },
    reading,
  };
}

/** `start` is when the page began to load, of performance.now(). */
function selfTest(model, view, panel, start) {
  const out = document.createElement('pre');
  out.id = 'selftest';
  out.hidden = true;
  try {
    const background = view.seen(1, 1);  // waits until the picture is there
    const seconds = (performance.now() - start) / 1000;
    const panes = view.rectangles().map((r) => paneReport(model, view, panel, r));
    const gl = view.renderer.getContext();
    const eye = view.orbit.camera.position.clone().normalize().toArray();
    out.textContent = JSON.stringify({
      seconds,
      faces: model.faces,
      vertices: model.vertices,
      background,
      eye,
      panes,
      captions: view.paneCount,
      glError: gl.getError(),
      errors: selfTestErrors,
    });
  } catch (error) {
    out.textContent = JSON.stringify({errors: [...selfTestErrors, String(error)]});
  }
  document.body.append(out);
  window.page = {model, view, panel};  // for tests that go on from here
}
