// The program that colours the surface. WebGL 1 with OES_standard_derivatives.
//
// `value` is the place of the field's value in its whole range, 0 to 1; of labels, the number of
// the label; far below 0 where it is infinite.

const kInfinitePlace = -1000;

// With PAIR it colours by two fields at once, into two images: panes that look at the surface from the
// same place share what costs most without a graphics card, the triangles.

const kVertexShader = `
attribute vec2 facet;
attribute float value;
varying float vValue;
#ifdef PAIR
attribute float value2;
varying float vValue2;
#endif
varying vec3 vNormal;
varying vec3 vSeen;
varying vec3 vPlace;

// The unit vector of octahedral coordinates.
vec3 unfolded(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (n.z < 0.0) {
    n.xy = (1.0 - abs(e.yx)) * vec2(e.x < 0.0 ? -1.0 : 1.0, e.y < 0.0 ? -1.0 : 1.0);
  }
  return normalize(n);
}

void main() {
  vec4 seen = modelViewMatrix * vec4(position, 1.0);
  vValue = value;
#ifdef PAIR
  vValue2 = value2;
#endif
  vNormal = normalMatrix * unfolded(facet);
  vSeen = seen.xyz;
  vPlace = position;
  gl_Position = projectionMatrix * seen;
}`;

const kFragmentShader = `
uniform sampler2D map;
uniform int colouring;     // 0: plain, 1: by the map, 2: labels
uniform int shading;       // 0: none, 1: the faces' own normals, 2: estimated ones
uniform vec2 window;       // the places at the ends of the map
uniform vec2 lines;        // isolines where x * value + y is an integer; x is 0 without
#ifdef PAIR
uniform sampler2D map2;
uniform int colouring2;
uniform vec2 window2;
uniform vec2 lines2;
varying float vValue2;
#endif
uniform vec4 lineColor;
uniform vec3 plainColor;
uniform vec3 infiniteColor;
uniform vec4 clip;         // what lies beyond the plane x . xyz = w is cut away
uniform float cutShade;    // of the inside, where a cut shows it
varying float vValue;
varying vec3 vNormal;
varying vec3 vSeen;
varying vec3 vPlace;

vec3 fieldColor(float value, sampler2D map, int colouring, vec2 window) {
  if (colouring == 0) return plainColor;
  if (value < -100.0) return infiniteColor;
  if (colouring == 2) return texture2D(map, vec2((mod(floor(value + 0.5), 256.0) + 0.5) / 256.0, 0.5)).rgb;
  float t = clamp((value - window.x) / (window.y - window.x), 0.0, 1.0);
  return texture2D(map, vec2((t * 255.0 + 0.5) / 256.0, 0.5)).rgb;
}

// How much of this pixel an isoline covers; the line is as wide on the screen wherever it runs.
float lineCover(float value, vec2 lines) {
  if (lines.x == 0.0) return 0.0;
  float level = lines.x * value + lines.y;
  float perPixel = fwidth(level);
  if (perPixel <= 0.0) return 0.0;
  float away = abs(fract(level + 0.5) - 0.5) / perPixel;
  float crowded = smoothstep(0.15, 0.5, perPixel);  // lines closer than that would run together
  return (1.0 - smoothstep(0.35, 1.35, away)) * (1.0 - crowded);
}

// With its isolines, not yet shaded.
vec3 lined(float value, sampler2D map, int colouring, vec2 window, vec2 lines, float level) {
  vec3 color = fieldColor(value, map, colouring, window);
  float cover = lineCover(value, lines) * level;
  return colouring == 1 && value > -100.0 ? mix(color, lineColor.rgb, lineColor.a * cover) : color;
}

void main() {
  if (dot(clip.xyz, vPlace) > clip.w) discard;
  // Derivatives before any branch that pixels of one face take differently.
  vec3 own = normalize(cross(dFdx(vSeen), dFdy(vSeen)));
  // Of a face seen from its edge, derivatives are no measure: the sides of steps would be specks.
  float level = smoothstep(0.05, 0.25, abs(dot(own, normalize(vSeen))));
  float light = 1.0;
  if (shading > 0) {
    vec3 eye = normalize(-vSeen);
    vec3 n = own;
    if (dot(n, eye) < 0.0) n = -n;
    if (shading == 2) n = normalize(vNormal);
    // The back is seen where the normal agrees that it is: between steps, specks of it shine through.
    bool inside = !gl_FrontFacing && (shading == 1 || dot(n, eye) < 0.0);
    if (shading == 2 && inside) n = -n;
    // Light from the eye keeps colours comparable, a second one from above shows the shape. A face
    // that looks at the eye has its field's colour.
    float front = max(dot(n, eye), 0.0);
    vec3 above = normalize(vec3(-0.35, 0.75, 0.55));
    float side = 0.5 + 0.5 * dot(n, above);
    float facing = 0.5 + 0.5 * dot(eye, above);
    light = mix(0.42, 1.0, front) * (1.0 + 0.4 * (side - facing));
    if (inside) light *= cutShade;
  }
  gl_FragData[0] = vec4(light * lined(vValue, map, colouring, window, lines, level), 1.0);
#ifdef PAIR
  gl_FragData[1] = vec4(light * lined(vValue2, map2, colouring2, window2, lines2, level), 1.0);
#endif
}`;
