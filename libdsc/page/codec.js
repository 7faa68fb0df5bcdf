// Blocks of the page as typed arrays: the reader of packing.h and arrays.h.

/** The bytes of base64 text without blanks. */
function bytesOfBase64(text) {
  const digits = new Uint8Array(128);
  const alphabet = 'ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/';
  for (let i = 0; i < 64; ++i) digits[alphabet.charCodeAt(i)] = i;
  let length = text.length;
  while (length > 0 && text[length - 1] === '=') --length;
  const bytes = new Uint8Array(Math.floor(length * 3 / 4));
  let bits = 0;
  let to = 0;
  for (let i = 0; i < length; ++i) {
    bits = (bits << 6 | digits[text.charCodeAt(i)]) & 0xffffff;
    const pending = (i & 3) * 2;  // bits of an unfinished byte after this digit: 6, 4, 2, 0
    if (pending > 0) bytes[to++] = bits >> (6 - pending);
  }
  return bytes;
}

/** What a zlib stream holds. */
async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * The integers of the byte planes that packing.h describes, interleaved: value i of component c is
 * element i * components + c.
 */
function integersOfPlanes(planes, components) {
  const total = planes.length / 4;
  const n = total / components;
  const values = new Int32Array(total);
  for (let c = 0; c < components; ++c) {
    let value = 0;
    for (let i = 0, at = c * n, to = c; i < n; ++i, ++at, to += components) {
      const z = planes[at] | planes[at + total] << 8 | planes[at + 2 * total] << 16 |
                planes[at + 3 * total] << 24;
      value = value + (z >>> 1 ^ -(z & 1)) | 0;
      values[to] = value;
    }
  }
  return values;
}

/** The floats whose bits these integers are; the memory is shared. */
function floatsOfIntegers(integers) {
  return new Float32Array(integers.buffer, integers.byteOffset, integers.length);
}
