/* global THREE */
// What stands still under an eye that stands still is drawn once: a picture begins with a copy of it.
const Backdrop = (() => {
"use strict";

const moving = 0, standing = 2;  // layers of three.js

return class Backdrop {
  static standing = standing;

  constructor(renderer, scene, camera) {
    Object.assign(this, { renderer, scene, camera });
    this.gl = renderer.getContext();
    this.can = renderer.capabilities.isWebGL2;
    this.steady = 0;  // pictures since something changed that should stand still
    camera.layers.enable(standing);
  }

  /// The eye has moved, or what stands still.
  renew() {
    this.steady = 0;
  }

  /// A picture; `plain`: of a look that has no use for what is around a part.
  draw(plain) {
    const first = this.steady++ === 0;
    if (!this.can || !plain || first) return this.renderer.render(this.scene, this.camera);
    this.fit();
    if (this.steady === 2) {
      this.renderer.setRenderTarget(this.behind);
      this.renderer.clear();
      this.only(standing);
    }
    this.renderer.setRenderTarget(this.whole);
    this.copy(this.behind, this.gl.COLOR_BUFFER_BIT | this.gl.DEPTH_BUFFER_BIT);
    this.renderer.autoClear = false;
    this.only(moving);
    this.renderer.autoClear = true;
    this.renderer.setRenderTarget(null);
    this.copy(this.whole, this.gl.COLOR_BUFFER_BIT);
  }

  only(layer) {
    this.camera.layers.set(layer);
    this.renderer.render(this.scene, this.camera);
    this.camera.layers.enable(moving);
    this.camera.layers.enable(standing);
  }

  /// Into what is drawn to now; three.js knows nothing of it.
  copy(from, what) {
    const { gl } = this, { width, height } = from, frame = (target) => this.renderer.properties.get(target).__webglFramebuffer;
    const drawn = this.renderer.getRenderTarget();
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, frame(from));
    gl.blitFramebuffer(0, 0, width, height, 0, 0, width, height, what, gl.NEAREST);
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, drawn ? frame(drawn) : null);
  }

  fit() {
    const { width, height } = this.renderer.domElement;
    if (this.whole?.width === width && this.whole.height === height) return;
    for (const old of [this.behind, this.whole]) old?.dispose();
    const options = { minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, generateMipmaps: false };
    [this.behind, this.whole] = [1, 2].map(() => new THREE.WebGLRenderTarget(width, height, options));
    this.steady = 2;
  }
};
})();
