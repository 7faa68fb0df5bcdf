// The controls: what they say goes into the view, what is picked comes out as a table.

const byId = (id) => document.getElementById(id);

class Panel {
  constructor(model, view, maps, wishes) {
    Object.assign(this, {model, view, maps});
    this.fillChoices();
    this.obey(wishes);
    this.listen();
    this.showCounts();
    this.update();
  }

  fillChoices() {
    const {scalars} = this.model;
    const options = scalars.map((scalar, i) => new Option(scalar.name, String(i)));
    byId('field').replaceChildren(...options, new Option('none', '-1'));
    byId('beside').replaceChildren(new Option('nothing', '-1'),
                                   ...options.map((option) => option.cloneNode(true)));
    // The naive field belongs beside the projected one.
    const compared = Math.max(0, scalars.findIndex((scalar) => this.naiveOf(scalar) >= 0));
    byId('field').value = scalars.length > 0 ? String(compared) : '-1';
    byId('beside').value = String(this.naiveOf(scalars[compared]));
    const names = this.maps.filter((map) => map.name !== 'labels').map((map) => map.name);
    byId('map').replaceChildren(new Option('by the field', ''), ...names.map((n) => new Option(n)));
    if (!this.model.normals) byId('shading').querySelector('[value=estimated]').remove();
  }

  /** The number of the scalar that the naive calculus gives in place of this one, or -1. */
  naiveOf(scalar) {
    if (!scalar) return -1;
    const name = scalar.name.replace(/\|?$/, (end) => `_naive${end}`);
    return this.model.scalars.findIndex((other) => other.name === name);
  }

  /** Sets controls by the page's address: #field=heat&beside=heat_naive&isolines=20&theme=dark … */
  obey(wishes) {
    for (const [id, wish] of wishes) {
      const control = byId(id);
      if (!control || !control.matches('select, input')) continue;
      if (control.type === 'checkbox') {
        control.checked = wish === 'on';
      } else if (control.tagName === 'SELECT') {
        const option = [...control.options].find((o) => o.text === wish || o.value === wish);
        if (option) control.value = option.value;
      } else {
        control.value = wish;
      }
    }
  }

  listen() {
    const {view} = this;
    byId('controls').addEventListener('input', (event) => {
      if (event.target.id === 'vertex') return;
      if (['field', 'beside', 'share'].includes(event.target.id)) this.clearRange();
      if (event.target.id === 'field' && byId('beside').value !== '-1') this.followField();
      this.update();
    });
    byId('controls').addEventListener('submit', (event) => event.preventDefault());
    byId('vertex').addEventListener('change', () => this.choose(byId('vertex').valueAsNumber));
    byId('all').addEventListener('click', () => this.setRange(null));
    byId('middle').addEventListener('click', () => this.setRange('middle'));
    byId('home').addEventListener('click', () => view.orbit.reset());
    byId('fold').addEventListener('click', () => this.fold());
    const scheme = window.matchMedia('(prefers-color-scheme: dark)');
    scheme.addEventListener('change', () => this.update());
    let down = null;
    view.canvas.addEventListener('pointerdown', (event) => {
      // A second finger makes a pinch of it, which picks nothing however still that finger is.
      down = view.orbit.pointers.size === 1 ? [event.clientX, event.clientY] : null;
    });
    view.canvas.addEventListener('pointercancel', () => { down = null; });
    view.canvas.addEventListener('pointerup', (event) => {
      const most = event.pointerType === 'touch' ? 10 : 4;
      const still = down && Math.hypot(event.clientX - down[0], event.clientY - down[1]) < most;
      down = null;
      if (still && event.button === 0) this.pickAt(event.clientX, event.clientY);
    });
    view.canvas.addEventListener('keydown', (event) => {
      if (event.key === 'Enter') this.pickMiddle();
      if (event.key === 'Escape') this.show(null);
    });
    view.arrange = () => this.arrange();
  }

  /** Another field's naive one stands beside it, where that of the last one stood. */
  followField() {
    const naive = this.naiveOf(this.shown()[0]);
    if (naive >= 0) byId('beside').value = String(naive);
  }

  fold() {
    const folded = document.body.classList.toggle('folded');
    byId('fold').setAttribute('aria-expanded', String(!folded));
    byId('fold').textContent = folded ? 'Controls' : 'Hide';
    this.view.request();
  }

  /** The scalars of the panes, the first perhaps null. */
  shown() {
    const of = (id) => this.model.scalars[Number(byId(id).value)] || null;
    return of('beside') ? [of('field'), of('beside')] : [of('field')];
  }

  clearRange() {
    byId('low').value = byId('high').value = '';
  }

  setRange(kind) {
    this.clearRange();
    if (kind) {
      const ranges = this.measured().map((scalar) => scalar[kind]);
      const ends = [Math.min(...ranges.map((r) => r.low)), Math.max(...ranges.map((r) => r.high))];
      const digits = digitsFor((ends[1] - ends[0]) / 1000, ends);
      ['low', 'high'].forEach((id, i) => { byId(id).value = Number(ends[i].toPrecision(digits)); });
    }
    this.update();
  }

  /** The scalars shown that have a size. */
  measured() {
    return this.shown().filter((scalar) => scalar && !scalar.labels);
  }

  /** Both panes' range where they share one; a half that is not typed in is the fields'. */
  rangeOf(scalars) {
    let low = Math.min(...scalars.map((s) => s.range.low));
    let high = Math.max(...scalars.map((s) => s.range.high));
    const diverging = this.mapOf(scalars).diverging;
    if (diverging) {
      high = Math.max(Math.abs(low), Math.abs(high));
      low = -high;
    }
    const size = high - low;
    const typed = [byId('low'), byId('high')].map((input) => input.valueAsNumber);
    const [isLow, isHigh] = typed.map(Number.isFinite);
    if (isLow) low = typed[0];
    if (isHigh) high = typed[1];
    if (isLow && isHigh && low > high) [low, high] = [high, low];  // typed backwards
    if (low < high) return {low, high};
    // Nothing lies between, as where the one end typed in is beyond all values: as wide as the field.
    const width = size > 0 && Number.isFinite(size) ? size : (Math.abs(low) || 1) * 1e-6;
    return isHigh && !isLow ? {low: high - width, high} : {low, high: low + width};
  }

  /** Signed values, of which neither sign is a trifle, get a diverging map. */
  mapOf(scalars) {
    const named = (name) => this.maps.find((map) => map.name === name);
    if (byId('map').value) return named(byId('map').value);
    const low = Math.min(...scalars.map((s) => s.range.low));
    const high = Math.max(...scalars.map((s) => s.range.high));
    const signed = low < -0.05 * high && high > -0.05 * low;
    return this.maps.find((map) => map.diverging === signed && map.name !== 'labels');
  }

  update() {
    const {view} = this;
    const shown = this.shown();
    const theme = byId('theme').value;
    document.documentElement.dataset.theme = theme;
    view.setPaneCount(shown.length);
    const measured = this.measured();
    const shared = shown.length === 2 && byId('share').checked && measured.length === 2;
    for (const id of ['low', 'high', 'all', 'middle', 'map']) byId(id).disabled = measured.length === 0;
    const when = {two: measured.length === 2, cut: byId('clip').value !== ''};
    for (const element of document.querySelectorAll('[data-when]')) {
      element.hidden = !when[element.dataset.when];
    }
    this.captions = shown.map((scalar, i) => {
      const surface = view.panes[i];
      surface.show(scalar);
      surface.shadeBy(byId('shading').value);
      if (!scalar) return {scalar};
      if (scalar.labels) {
        const map = this.maps.find((m) => m.name === 'labels');
        surface.colourBy(map, scalar.range.low, scalar.range.high, 0);
        return {scalar, map};
      }
      const scalars = shared ? measured : [scalar];
      const map = this.mapOf(scalars);
      const {low, high} = this.rangeOf(scalars);
      const count = byId('isolines').valueAsNumber || 0;
      const step = count > 0 && scalar.range.low < scalar.range.high ? roundStep(high - low, count) : 0;
      surface.colourBy(map, low, high, step);
      return {scalar, map, low, high, step};
    });
    this.clip();
    this.captionElements = this.captions.map((caption) => captionOf(caption));
    byId('captions').replaceChildren(...this.captionElements);
    this.captionWidth = 0;
    byId('lines').textContent = this.lineText();
    this.show(this.view.picked);
    view.request();
  }

  lineText() {
    const steps = [...new Set(this.captions.filter((c) => c.step && c.scalar.on === 'vertex')
        .map((c) => textOf(c.step)))];
    if (steps.length > 0) return `every ${steps.join(', ')}`;
    return this.measured().some((s) => s.on === 'vertex') ? 'none' : 'of vertex fields only';
  }

  /** The plane of the controls. */
  clip() {
    const axis = ['x', 'y', 'z'].indexOf(byId('clip').value);
    let plane = null;
    if (axis >= 0) {
      const sign = byId('flip').checked ? -1 : 1;
      const place = byId('place').valueAsNumber * this.model.half[axis];
      const normal = [0, 0, 0];
      normal[axis] = sign;
      plane = {normal, offset: sign * place};
      const world = this.model.centre[axis] + this.model.radius * place;
      byId('cut').textContent = `${byId('clip').value} ${sign < 0 ? '<' : '>'} ${textOf(world, 4)} is hidden`;
    }
    this.view.plane = plane;
    for (const surface of this.view.panes) surface.clipBy(plane);
  }

  /** Each caption at the bottom of its pane, which ends above the higher one of them. */
  arrange() {
    const tiles = this.view.tiles();
    const width = Math.max(60, Math.min(420, tiles[0].width - 48));
    tiles.forEach((r, i) => {
      const {style} = this.captionElements[i];
      style.left = `${r.x + r.width / 2}px`;
      style.top = `${r.y + r.height}px`;
      style.width = `${width}px`;
      if (width !== this.captionWidth) writeTicks(this.captionElements[i], this.captions[i], width);
    });
    this.captionWidth = width;
    this.view.footer = Math.max(...this.captionElements.map((caption) => caption.offsetHeight));
  }

  pickAt(x, y) {
    const start = performance.now();
    this.show(this.view.pick(x, y));
    this.pickTime = performance.now() - start;
  }

  pickMiddle() {
    const r = this.view.rectangles()[0];
    this.pickAt(r.x + r.width / 2, r.y + r.height / 2);
  }

  /** Reads a vertex by its number. */
  choose(vertex) {
    const known = Number.isInteger(vertex) && vertex >= 0 && vertex < this.model.vertices;
    this.show(known ? {face: -1, vertex} : null);
  }

  /** The table of what is picked; null: nothing is. */
  show(picked) {
    const {model} = this;
    this.view.picked = picked;
    const rows = [];
    const add = (name, value) => rows.push([name, value]);
    if (picked) {
      add('vertex', String(picked.vertex));
      ['x', 'y', 'z'].forEach((name, axis) => add(name, textOf(model.coordinate(picked.vertex, axis))));
      const values = (on, i) => {
        for (const scalar of model.scalars) {
          if (scalar.on === on) add(scalar.name, textOf(scalar.at(i)));
        }
      };
      values('vertex', picked.vertex);
      if (picked.face >= 0) {
        add('face', String(picked.face));
        values('face', picked.face);
      }
    }
    byId('reading').replaceChildren(...rows.map(([name, value]) => {
      const row = document.createElement('tr');
      const head = document.createElement('th');
      head.scope = 'row';
      head.textContent = name;
      const cell = document.createElement('td');
      cell.textContent = value;
      row.append(head, cell);
      return row;
    }));
    byId('hint').hidden = rows.length > 0;
    byId('vertex').value = picked ? picked.vertex : '';
    this.view.drawMarks();
  }

  showCounts() {
    const count = (n, one, more) => `${n.toLocaleString('en').replace(/,/g, '\u202f')} ${n === 1 ? one : more}`;
    byId('counts').textContent = `${count(this.model.faces, 'face', 'faces')}, ` +
        count(this.model.vertices, 'vertex', 'vertices');
    byId('vertex').max = String(this.model.vertices - 1);
  }
}

/** A new child of an element. */
function element(parent, name, text = '', className = '') {
  const child = document.createElement(name);
  child.textContent = text;
  if (className) child.className = className;
  parent.append(child);
  return child;
}

/** The name of a field above its colours; writeTicks() adds the numbers. */
function captionOf({scalar, map, low, high}) {
  const caption = document.createElement('figure');
  if (!scalar) return caption;
  element(caption, 'figcaption', scalar.name);
  if (scalar.labels) {
    const most = 24;
    const list = element(caption, 'div', '', 'labels');
    scalar.distinct.slice(0, most).forEach((value, i) => {
      element(list, 'span', textOf(value)).style.setProperty('--swatch', map.css(i % 256));
    });
    const more = scalar.distinct.length - most;
    if (more > 0) element(list, 'em', `and ${more} more`);
    return caption;
  }
  const {range} = scalar;
  if (range.none) {
    element(caption, 'p', 'grey: infinite everywhere');
    return caption;
  }
  const bar = element(caption, 'div', '', 'bar');
  bar.style.background = map.gradient;
  element(caption, 'div', '', 'scale');
  const size = high - low;
  if (range.low < low - 1e-6 * size) bar.classList.add('below');
  if (range.high > high + 1e-6 * size) bar.classList.add('above');
  if (range.infinite) element(caption, 'p', 'grey: infinite');
  return caption;
}

/** The numbers under the colours of a caption, as many as have room in this width. */
function writeTicks(caption, {low, high}, width) {
  const scale = caption.querySelector('.scale');
  if (!scale) return;
  for (let count = 5; count > 0; --count) {
    const ticks = ticksOf(low, high, count);
    const digits = digitsFor(ticks.length > 1 ? ticks[1] - ticks[0] : high - low, ticks);
    scale.replaceChildren();
    for (const tick of ticks) {
      const mark = element(scale, 'span', textOf(tick, digits));
      mark.style.left = `${100 * (tick - low) / (high - low)}%`;
    }
    const widest = Math.max(...[...scale.children].map((mark) => mark.offsetWidth));
    const apart = ticks.length > 1 ? width * (ticks[1] - ticks[0]) / (high - low) : Infinity;
    if (widest + 10 < apart) return;
  }
}
