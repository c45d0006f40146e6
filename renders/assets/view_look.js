/* global THREE, Backdrop */
// How the machine looks, in the live page and in the report: fine, with shadows and mirrored lamps, or plain, for computers without a graphics card,
// where every pixel counts: light at the corners only, a shadow that stands still. Colours are the film's.
const Look = (() => {
"use strict";

const paper = (width, height) => Object.assign(document.createElement("canvas"), { width, height });

const toLight = [0.37, 0.82, 0.45];
const squares = 60;

/// Whether pictures are computed by the processor itself.
function isSlow() {
  const probe = paper(1, 1).getContext("webgl");
  if (!probe) throw new Error("this browser gives no WebGL");
  const told = probe.getExtension("WEBGL_debug_renderer_info");
  const name = told ? probe.getParameter(told.UNMASKED_RENDERER_WEBGL) : "";
  probe.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/// What a shiny surface mirrors: floor, walls, a ceiling with a row of lamps.
function hall() {
  const face = (paint) => {
    const canvas = paper(64, 64);
    paint(canvas.getContext("2d"));
    return canvas;
  };
  const plain = (shade) => (g) => {
    g.fillStyle = shade;
    g.fillRect(0, 0, 64, 64);
  };
  const wall = (g) => {
    const shade = g.createLinearGradient(0, 0, 0, 64);
    shade.addColorStop(0, "#f8fbff");
    shade.addColorStop(0.5, "#cad0d6");
    shade.addColorStop(0.52, "#949ba2");
    shade.addColorStop(1, "#74777b");
    plain(shade)(g);
  };
  const ceiling = (g) => {
    plain("#dfe6ec")(g);
    g.fillStyle = "#ffffff";
    for (const x of [8, 28, 48]) g.fillRect(x, 4, 8, 56);
  };
  const texture = new THREE.CubeTexture([wall, wall, ceiling, plain("#74777b"), wall, wall].map(face));
  texture.needsUpdate = true;
  return texture;
}

const plainVertex = `
uniform float mirror;
varying mediump vec3 shade;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vec3 n = normalize(mat3(modelMatrix) * normal);
  float key = max(dot(n, normalize(vec3(${toLight.join(", ")}))), 0.0);
  float fill = max(dot(n, normalize(vec3(0.75, 0.25, 0.6))), 0.0);
  vec3 ambient = mix(vec3(0.17, 0.165, 0.16), vec3(0.42, 0.45, 0.49), n.y * 0.5 + 0.5);
  vec3 seen = color * (ambient + vec3(0.15, 0.17, 0.20) * fill + vec3(0.92, 0.89, 0.84) * key);
  if (mirror > 0.0) {
    vec3 d = reflect(normalize(world.xyz - cameraPosition), n);
    vec3 behind = d.y < 0.0 ? mix(vec3(0.34, 0.36, 0.38), vec3(0.20, 0.20, 0.21), smoothstep(0.0, 0.5, -d.y))
                            : mix(vec3(0.62, 0.66, 0.70), vec3(0.95, 0.97, 1.0), smoothstep(0.0, 0.9, d.y));
    seen = mix(seen, behind * mix(vec3(1.0), color * 1.5, 0.6), mirror);
  }
  shade = sqrt(clamp(seen, 0.0, 1.0));
  gl_Position = projectionMatrix * viewMatrix * world;
}`;
const plainFragment = "varying mediump vec3 shade;\nvoid main() { gl_FragColor = vec4(shade, 1.0); }";

// A shadow as it falls on the floor, seen from above.
const shadowVertex = `
uniform vec3 centre;
uniform float reach;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  vec2 fallen = world.xz - vec2(${toLight[0]}, ${toLight[2]}) * max(world.y - centre.y, 0.0) / ${toLight[1]};
  gl_Position = vec4((fallen - centre.xz) / reach * vec2(1.0, -1.0), 0.0, 1.0);
}`;
const shadowFragment = "void main() { gl_FragColor = vec4(0.0, 0.0, 0.0, 1.0); }";
// It is blurred once: on the floor a pixel looks it up and no more.
const blurVertex = "varying vec2 at;\nvoid main() { at = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }";
const blurFragment = `
uniform sampler2D map;
varying vec2 at;
void main() {
  float covered = 0.0;
  for (int x = -4; x <= 4; ++x) for (int y = -4; y <= 4; ++y) covered += texture2D(map, at + vec2(x, y) * 0.0022).a;
  gl_FragColor = vec4(0.05, 0.06, 0.08, 0.4 * covered / 81.0);
}`;
const fallenVertex = "varying vec2 at;\nvoid main() { at = uv; gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }";
const fallenFragment = "uniform sampler2D map;\nvarying mediump vec2 at;\nvoid main() { gl_FragColor = texture2D(map, at); }";

return class Look {
  static isSlow = isSlow;

  /// `colour`: what a variable of the style sheet stands for now.
  constructor(renderer, scene, fine, colour) {
    Object.assign(this, { renderer, scene, fine, colour });
    renderer.setClearColor(0x000000, 0);
    renderer.gammaFactor = 2;
    renderer.gammaOutput = fine;
    renderer.shadowMap.enabled = fine;
    renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.grid = new THREE.GridHelper(1, squares, 0xffffff, 0xffffff);
    this.grid.material = new THREE.LineBasicMaterial({ transparent: true, depthWrite: false });
    this.floor = new THREE.Mesh(new THREE.PlaneBufferGeometry(2, 2).rotateX(-Math.PI / 2));
    for (const one of [this.grid, this.floor]) one.layers.set(Backdrop.standing);
    scene.add(this.grid, this.floor);
    if (fine) {
      this.lamp = new THREE.DirectionalLight(0xfff6ea, 0.8);
      this.lamp.castShadow = true;
      this.lamp.shadow.mapSize.set(2048, 2048);
      this.lamp.shadow.bias = -0.0006;
      const fill = new THREE.DirectionalLight(0xdfe8f2, 0.18);
      fill.position.set(0.75, 0.25, 0.6);
      this.lights = [new THREE.HemisphereLight(0xffffff, 0x807c76, 0.5), this.lamp, this.lamp.target, fill];
      scene.add(...this.lights);
      this.floor.material = new THREE.ShadowMaterial({ opacity: 0.38 });
      this.floor.receiveShadow = true;
    } else {
      const target = () => new THREE.WebGLRenderTarget(512, 512, { minFilter: THREE.LinearFilter, depthBuffer: false, stencilBuffer: false });
      [this.sharp, this.soft] = [target(), target()];
      const uniforms = { centre: { value: new THREE.Vector3() }, reach: { value: 1 } };
      this.caster = new THREE.ShaderMaterial({ vertexShader: shadowVertex, fragmentShader: shadowFragment, uniforms, depthTest: false, side: THREE.DoubleSide });
      this.blur = new THREE.Mesh(new THREE.PlaneBufferGeometry(2, 2), new THREE.ShaderMaterial({ vertexShader: blurVertex,
        fragmentShader: blurFragment, depthTest: false, uniforms: { map: { value: this.sharp.texture } } }));
      this.blur.frustumCulled = false;
      this.floor.material = new THREE.ShaderMaterial({ vertexShader: fallenVertex, fragmentShader: fallenFragment, transparent: true,
        depthWrite: false, uniforms: { map: { value: this.soft.texture } } });
    }
    this.looks = new Map();
    this.paint();
  }

  /// Colours of the hall, by day or night; behind the picture is the style sheet's.
  paint() {
    this.scene.fog = new THREE.Fog(new THREE.Color(this.colour("hall")), 1, 100);
    this.grid.material.color = new THREE.Color(this.colour("hall-line"));
    // Lines are colours of the page: as they are written, whatever the gamma.
    if (this.fine) for (const one of [this.grid.material.color, this.scene.fog.color]) one.convertGammaToLinear(2);
    this.fogAt();
  }
  fogAt() {
    this.scene.fog.near = 3 * (this.size ?? 1);
    this.scene.fog.far = 11 * (this.size ?? 1);
  }

  dress(model) {
    model.traverse((node) => {
      if (!node.isMesh) return;
      node.castShadow = node.receiveShadow = this.fine;
      node.frustumCulled = false;
      const { name, metalness } = node.material;
      if (!this.looks.has(name)) this.looks.set(name, this.material(metalness > 0.5));
      node.material = this.looks.get(name);
    });
  }
  material(metal) {
    if (!this.fine)
      return new THREE.ShaderMaterial({ vertexColors: THREE.VertexColors, vertexShader: plainVertex, fragmentShader: plainFragment,
        uniforms: { mirror: { value: metal ? 0.45 : 0 } } });
    this.mirrored = this.mirrored ?? hall();
    return metal
      ? new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, shininess: 90, specular: 0x777777, envMap: this.mirrored,
        combine: THREE.MixOperation, reflectivity: 0.4 })
      : new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, shininess: 24, specular: 0x1a1a1a });
  }

  /// Floor and lamp for a machine in that box.
  furnish(box) {
    const { center, radius } = box.getBoundingSphere(new THREE.Sphere());
    this.size = radius;
    const spacing = radius > 2.5 ? 0.5 : radius > 1 ? 0.2 : 0.1;
    this.grid.scale.setScalar(squares * spacing);
    this.grid.position.set(center.x, box.min.y, center.z);
    this.floor.position.set(center.x, box.min.y + 0.001, center.z);
    this.floor.scale.setScalar((this.fine ? 1.7 : 1.4) * radius);
    this.fogAt();
    if (!this.fine) return this.drop(center, box.min.y, 1.4 * radius);
    this.lamp.target.position.copy(center);
    this.lamp.position.copy(center).addScaledVector(new THREE.Vector3(...toLight).normalize(), 3 * radius);
    const reached = 1.1 * radius;
    const { camera } = this.lamp.shadow;
    Object.assign(camera, { left: -reached, right: reached, top: reached, bottom: -reached, near: radius, far: 6 * radius });
    camera.updateProjectionMatrix();
  }

  /// The plain look's shadow, as the machine stands now.
  drop(center, level, reach) {
    const { renderer, scene, caster } = this;
    caster.uniforms.centre.value.set(center.x, level, center.z);
    caster.uniforms.reach.value = reach;
    this.grid.visible = this.floor.visible = false;
    scene.overrideMaterial = caster;
    renderer.setRenderTarget(this.sharp);
    renderer.clear();
    const above = new THREE.Camera();
    above.layers.enable(Backdrop.standing);
    renderer.render(scene, above);
    renderer.setRenderTarget(this.soft);
    renderer.clear();
    renderer.render(this.blur, new THREE.Camera());
    renderer.setRenderTarget(null);
    scene.overrideMaterial = null;
    this.grid.visible = this.floor.visible = true;
  }

  /// Leaves the scene as it was before.
  go() {
    this.scene.remove(this.grid, this.floor, ...(this.lights ?? []));
  }
};
})();
