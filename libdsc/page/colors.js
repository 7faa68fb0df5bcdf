// Colour maps and the numbers beside them.

/** A colour map of the manifest: 256 colours as bytes. */
class ColorMap {
  constructor({name, diverging, rgb}) {
    this.name = name;
    this.diverging = diverging;
    this.bytes = new Uint8Array(768);
    for (let i = 0; i < 768; ++i) this.bytes[i] = parseInt(rgb.substr(2 * i, 2), 16);
    this.texture = new THREE.DataTexture(this.bytes, 256, 1, THREE.RGBFormat);
    this.texture.minFilter = this.texture.magFilter =
        name === 'labels' ? THREE.NearestFilter : THREE.LinearFilter;
    this.texture.needsUpdate = true;
  }

  css(entry) {
    return `rgb(${this.bytes.subarray(3 * entry, 3 * entry + 3).join()})`;
  }

  get gradient() {
    const stops = Array.from({length: 33}, (_, i) => this.css(Math.round(i * 255 / 32)));
    return `linear-gradient(to right, ${stops.join()})`;
  }
}

/** The round number (1, 2 or 5 times a power of 10) nearest above size / count. */
function roundStep(size, count) {
  const raw = size / count;
  if (!(raw > 0) || !Number.isFinite(raw)) return 0;
  const power = 10 ** Math.floor(Math.log10(raw));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= raw * (1 - 1e-9));
}

/** The multiples of a round step within [low, high], about `count` of them. */
function ticksOf(low, high, count) {
  const step = roundStep(high - low, count);
  if (step === 0) return [low];
  const ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) {
    ticks.push(k * step);
  }
  return ticks;
}

/** How many digits tell numbers apart that differ by `step`: 6 or more, at most those of a double. */
function digitsFor(step, numbers) {
  const most = Math.max(...numbers.map(Math.abs));
  if (!(step > 0) || !(most > 0)) return 6;
  return Math.min(15, Math.max(6, Math.ceil(Math.log10(most / step)) + 2));
}

/** A value in as many digits as it has. */
function textOf(value, digits = 7) {
  if (value === Infinity) return '∞';
  if (value === -Infinity) return '−∞';
  const size = Math.abs(value);
  const short = Number(value.toPrecision(digits));
  const text = size !== 0 && (size < 1e-4 || size >= 1e7) ? short.toExponential() : String(short);
  return text.replace(/-/g, '−');
}
