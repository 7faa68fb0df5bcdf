// Two panes by one passage over the surface: they look at it from the same place, so that only its
// colours differ. Without a graphics card this halves the time of a picture.

/** Whether this context draws into two images at once. */
function canPair(renderer) {
  const gl = renderer.getContext();
  const extension = gl.getExtension('WEBGL_draw_buffers');
  return extension !== null && gl.getParameter(extension.MAX_DRAW_BUFFERS_WEBGL) >= 2;
}

class Pair {
  /** Of two ColoredSurface over `shared`; what they show is what this one draws. */
  constructor(renderer, shared, [first, second]) {
    this.renderer = renderer;
    const {map, colouring, window, lines} = second.uniforms;
    const uniforms =
        {...first.uniforms, map2: map, colouring2: colouring, window2: window, lines2: lines};
    this.scene = sceneOf(shared, {value: first.values, value2: second.values}, uniforms,
                         {defines: {PAIR: 1}, extensions: {derivatives: true, drawBuffers: true}});
    this.image = {value: null};
    const sheet = new THREE.Mesh(new THREE.PlaneBufferGeometry(2, 2), new THREE.ShaderMaterial({
      uniforms: {image: this.image},
      vertexShader: 'varying vec2 vPlace; void main() { vPlace = uv; gl_Position = vec4(position, 1.0); }',
      fragmentShader: 'uniform sampler2D image; varying vec2 vPlace;' +
          'void main() { gl_FragColor = texture2D(image, vPlace); }',
      depthTest: false,
      depthWrite: false,
    }));
    sheet.frustumCulled = false;
    this.sheet = new THREE.Scene();
    this.sheet.add(sheet);
    this.images = [];
  }

  /** Two images of this size with one depth. */
  resize(width, height) {
    const {renderer} = this;
    const [old] = this.images;
    if (old && old.width === width && old.height === height) return;
    for (const image of this.images) image.dispose();
    this.images = [true, false].map((depthBuffer) => new THREE.WebGLRenderTarget(width, height, {
      minFilter: THREE.NearestFilter,
      magFilter: THREE.NearestFilter,
      depthBuffer,
      stencilBuffer: false,
    }));
    // three.js r111 knows no frame with two images: the second joins the first's by hand.
    const gl = renderer.getContext();
    const extension = gl.getExtension('WEBGL_draw_buffers');
    renderer.setRenderTarget(this.images[1]);
    renderer.setRenderTarget(this.images[0]);
    const texture = renderer.properties.get(this.images[1].texture).__webglTexture;
    gl.framebufferTexture2D(
        gl.FRAMEBUFFER, extension.COLOR_ATTACHMENT1_WEBGL, gl.TEXTURE_2D, texture, 0);
    extension.drawBuffersWEBGL(
        [extension.COLOR_ATTACHMENT0_WEBGL, extension.COLOR_ATTACHMENT1_WEBGL]);
  }

  /** `places`: the panes on the canvas, of one size, each {x, y, width, height} from below. */
  draw(places, camera) {
    const {renderer} = this;
    const ratio = renderer.getPixelRatio();
    const {width, height} = places[0];
    this.resize(...[width, height].map((size) => Math.max(1, Math.floor(size * ratio))));
    renderer.setRenderTarget(this.images[0]);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.setRenderTarget(null);
    places.forEach((place, i) => {
      renderer.setViewport(place.x, place.y, place.width, place.height);
      renderer.setScissor(place.x, place.y, place.width, place.height);
      this.image.value = this.images[i].texture;
      renderer.render(this.sheet, camera);
    });
  }
}
