/* global THREE */
// The machine in 3-D: the parts of machine.glb, moved by the poses of the news, drawn in between.
import { by, make, colour } from "./live_dom.js";
import { address } from "./live_link.js";

const numbersAPart = 10;  // position 3, quaternion 4, scale 3
const jump = 0.25;        // [m] who moves so far between two news is put there
const slowFrame = 45;     // [ms] then less is drawn
const directions = {
  free: [0.5, 0.42, 0.85],
  front: [0, 0.12, 1],
  top: [0, 1, 0.001],
  end: [1, 0.15, 0.001],
};

/// What a shiny surface mirrors: floor, walls, a ceiling with a row of lamps.
function hall() {
  const face = (paint) => {
    const canvas = make("canvas", { width: 64, height: 64 });
    paint(canvas.getContext("2d"));
    return canvas;
  };
  const wall = (g) => {
    const shade = g.createLinearGradient(0, 0, 0, 64);
    shade.addColorStop(0, "#e8edf2");
    shade.addColorStop(0.5, "#aeb7c0");
    shade.addColorStop(1, "#4b5055");
    g.fillStyle = shade;
    g.fillRect(0, 0, 64, 64);
  };
  const ceiling = (g) => {
    g.fillStyle = "#cfd8e0";
    g.fillRect(0, 0, 64, 64);
    g.fillStyle = "#ffffff";
    for (const x of [8, 28, 48]) g.fillRect(x, 4, 8, 56);
  };
  const floor = (g) => {
    g.fillStyle = "#3c4044";
    g.fillRect(0, 0, 64, 64);
  };
  const texture = new THREE.CubeTexture([wall, wall, ceiling, floor, wall, wall].map(face));
  texture.needsUpdate = true;
  return texture;
}

export class Machine {
  constructor() {
    this.holder = by("view");
    this.parts = [];
    this.frames = 0;  // drawn so far
    this.level = 0;   // 0 = all of it, 1 = shadows stand still, 2 = without shadows, coarser
    this.stale = true;
    try {
      if (typeof THREE === "undefined")
        throw new Error("The machine cannot be shown: three.js (package libjs-three) is not installed.");
      this.stage();
    } catch (error) {
      this.broken = true;
      const told = /three.js/.test(error.message) ? error.message
        : "The machine cannot be shown: this browser gives no WebGL.";
      this.holder.append(make("p", { className: "notice", textContent: told }));
      by("views").hidden = true;
    }
  }

  stage() {
    // What three.js writes to the console about a missing WebGL is said in the page.
    const canvas = make("canvas", { tabIndex: 0, attributes: {
      "aria-label": "The machine in 3-D. Arrows turn it, plus and minus come nearer and go away.", role: "img" } });
    const context = canvas.getContext("webgl", { antialias: true, powerPreference: "high-performance" });
    if (!context) throw new Error("no WebGL");
    this.renderer = new THREE.WebGLRenderer({ canvas, context });
    this.renderer.gammaOutput = true;
    this.renderer.gammaFactor = 2;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.holder.append(canvas);
    this.canvas = canvas;

    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.02, 200);
    this.orbit = new THREE.OrbitControls(this.camera, canvas);
    this.orbit.enableKeys = false;
    this.orbit.maxPolarAngle = Math.PI / 2 - 0.02;
    this.orbit.addEventListener("change", () => { this.stale = true; });
    this.orbit.addEventListener("start", () => this.choose(null));
    canvas.addEventListener("keydown", (event) => this.key(event));

    this.sky = new THREE.HemisphereLight(0xffffff, 0x777570, 0.62);
    this.lamp = new THREE.DirectionalLight(0xfff4e6, 0.78);
    this.lamp.castShadow = true;
    this.lamp.shadow.mapSize.set(1024, 1024);
    this.lamp.shadow.bias = -0.0008;
    const fill = new THREE.DirectionalLight(0xdfe8f2, 0.16);
    fill.position.set(0.75, 0.25, 0.6);
    this.floor = new THREE.Mesh(new THREE.CircleBufferGeometry(1, 48).rotateX(-Math.PI / 2),
      new THREE.MeshLambertMaterial({ color: 0xffffff }));
    this.floor.receiveShadow = true;
    this.scene.add(this.sky, this.lamp, this.lamp.target, fill, this.floor);
    this.mirrored = hall();
    new ResizeObserver(() => this.fit()).observe(this.holder);
    requestAnimationFrame((now) => this.draw(now));
    this.paint();
  }

  /// Colours of the hall, by day or night.
  paint() {
    if (this.broken) return;
    const of = (name) => new THREE.Color(colour(name)).convertGammaToLinear(2);
    this.scene.background = new THREE.Color(colour("hall")).convertGammaToLinear(2);
    this.scene.fog = new THREE.Fog(this.scene.background, 1, 100);
    this.floor.material.color = of("hall-floor");
    this.grid?.material.color.copy(of("hall-line"));
    this.fogAt();
    this.stale = true;
  }

  /// The machine of another run.
  async line(line) {
    if (this.broken) return;
    const run = line.run;
    this.wanted = run;
    const bytes = await fetch(address("machine.glb")).then((answer) => (answer.ok ? answer.arrayBuffer() : null), () => null);
    if (bytes === null || bytes.byteLength === 0 || this.wanted !== run) return;
    const model = await new Promise((done, failed) => new THREE.GLTFLoader().parse(bytes, "", done, failed));
    if (this.wanted !== run) return;
    const first = !this.model;
    if (this.model) this.scene.remove(this.model);
    this.model = model.scene;
    this.dress(model.scene);
    // As the loader calls a node: without what its own paths cannot hold.
    const called = (name) => THREE.PropertyBinding.sanitizeNodeName(name);
    const nodes = new Map();
    model.scene.traverse((node) => nodes.set(node.name, node));
    this.parts = line.parts.map((name) => nodes.get(called(name)));
    for (const part of this.parts) if (part) part.matrixAutoUpdate = false;
    this.names = line.parts;
    this.before = this.after = null;
    this.scene.add(model.scene);
    this.offerViews(line.parts);
    if (this.waiting) this.take(this.waiting);
    if (first || !this.bounds) {
      this.bounds = null;
      this.pending = true;
    }
    this.stale = true;
  }

  dress(model) {
    const looks = new Map();
    model.traverse((node) => {
      if (!node.isMesh) return;
      node.castShadow = node.receiveShadow = true;
      node.frustumCulled = false;
      const from = node.material;
      if (!looks.has(from.name)) {
        const metal = from.metalness > 0.5;
        looks.set(from.name, metal
          ? new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, shininess: 90, specular: 0x777777,
            envMap: this.mirrored, combine: THREE.MixOperation, reflectivity: 0.38 })
          : new THREE.MeshPhongMaterial({ vertexColors: THREE.VertexColors, shininess: 24, specular: 0x1c1c1c }));
      }
      node.material = looks.get(from.name);
    });
  }

  news(news) {
    if (this.broken) return;
    const poses = Float32Array.from(news.poses);
    const still = this.waiting && this.waiting.time === news.time && this.waiting.run === news.run;
    const told = { poses, time: news.time, run: news.run, at: performance.now() };
    this.waiting = told;
    if (still || !this.model || this.wanted !== news.run) return;
    this.take(told);
  }

  take(told) {
    if (told.poses.length !== this.parts.length * numbersAPart) return;
    const apart = this.after ? told.at - this.after.at : 33;
    this.interval = Math.min(100, Math.max(16, apart));
    this.before = this.after ?? told;
    this.after = told;
    this.settled = false;
    if (this.pending) {
      this.pending = false;
      this.place(1);
      this.look("free", null);
    }
  }

  /// The parts, a share of the way from the news before to the latest.
  place(share) {
    const { poses: a } = this.before;
    const { poses: b } = this.after;
    const position = new THREE.Vector3(), other = new THREE.Vector3(), scale = new THREE.Vector3();
    const turn = new THREE.Quaternion(), otherTurn = new THREE.Quaternion();
    this.parts.forEach((part, i) => {
      if (!part) return;
      const at = i * numbersAPart;
      scale.fromArray(b, at + 7);
      part.visible = scale.x !== 0;
      if (!part.visible) return;
      other.fromArray(b, at);
      otherTurn.fromArray(b, at + 3);
      position.fromArray(a, at);
      turn.fromArray(a, at + 3);
      if (a[at + 7] === 0 || position.distanceToSquared(other) > jump * jump) {
        position.copy(other);
        turn.copy(otherTurn);
      } else {
        position.lerp(other, share);
        turn.slerp(otherTurn, share);
      }
      part.matrix.compose(position, turn, scale);
      part.matrixWorldNeedsUpdate = true;
    });
  }

  /// Around the parts of a plant, of all if it is null; pieces do not count.
  boundsOf(plant) {
    const box = new THREE.Box3();
    this.scene.updateMatrixWorld(true);
    this.parts.forEach((part, i) => {
      const name = this.names[i];
      if (part?.visible && (plant === null || name.startsWith(plant + ".")) && !/\.(piece|belt mark)/.test(name))
        box.expandByObject(part);
    });
    return box;
  }

  look(from, plant) {
    if (this.broken || !this.after) return;
    const all = this.boundsOf(null);
    if (all.isEmpty()) return;
    this.bounds = all;
    this.furnish(all);
    const box = plant === null ? all : this.boundsOf(plant);
    const ball = (box.isEmpty() ? all : box).getBoundingSphere(new THREE.Sphere());
    const way = new THREE.Vector3(...directions[from]).normalize();
    // As far as the box needs, from there: its corners are inside the picture.
    const half = Math.tan(THREE.Math.degToRad(this.camera.fov / 2));
    const right = new THREE.Vector3().crossVectors(new THREE.Vector3(0, 1, 0), way).normalize();
    const up = new THREE.Vector3().crossVectors(way, right);
    const centre = (box.isEmpty() ? all : box).getCenter(new THREE.Vector3());
    let far = 0.2 * ball.radius;
    for (const x of [box.min.x, box.max.x]) for (const y of [box.min.y, box.max.y]) for (const z of [box.min.z, box.max.z]) {
      const corner = new THREE.Vector3(x, y, z).sub(centre);
      const wide = Math.abs(corner.dot(right)) / (half * this.camera.aspect);
      const high = Math.abs(corner.dot(up)) / half;
      far = Math.max(far, corner.dot(way) + 1.08 * Math.max(wide, high));
    }
    this.orbit.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(way, far);
    this.orbit.minDistance = 0.1 * ball.radius;
    this.orbit.maxDistance = 12 * all.getBoundingSphere(new THREE.Sphere()).radius;
    this.orbit.update();
    this.choose(from === "free" ? plant ?? "" : from);
    this.stale = true;
  }

  /// Floor and lamp for a machine of that size.
  furnish(box) {
    const ball = box.getBoundingSphere(new THREE.Sphere());
    const reach = 14 * ball.radius;
    this.floor.scale.setScalar(reach);
    this.floor.position.set(ball.center.x, box.min.y - 0.002, ball.center.z);
    if (!this.grid) {
      const squares = 56;
      this.grid = new THREE.GridHelper(1, squares, 0xffffff, 0xffffff);
      this.grid.material = new THREE.LineBasicMaterial({ transparent: true, opacity: 0.5 });
      this.scene.add(this.grid);
    }
    const spacing = ball.radius > 2.5 ? 1 : ball.radius > 1 ? 0.5 : 0.2;
    this.grid.scale.setScalar(56 * spacing);
    this.grid.position.set(ball.center.x, box.min.y, ball.center.z);
    const { shadow } = this.lamp;
    this.lamp.target.position.copy(ball.center);
    this.lamp.position.copy(ball.center).addScaledVector(new THREE.Vector3(0.45, 1, 0.55).normalize(), 3 * ball.radius);
    const reached = 1.1 * ball.radius;
    Object.assign(shadow.camera, { left: -reached, right: reached, top: reached, bottom: -reached,
      near: ball.radius, far: 6 * ball.radius });
    shadow.camera.updateProjectionMatrix();
    this.size = ball.radius;
    this.paint();
  }

  fogAt() {
    if (!this.size || !this.scene.fog) return;
    this.scene.fog.near = 5 * this.size;
    this.scene.fog.far = 13 * this.size;
  }

  offerViews(parts) {
    const plants = [...new Set(parts.map((name) => name.split(".")[0]))];
    const views = [["whole line", "free", null], ...(plants.length > 1 ? plants.map((name) => [name, "free", name]) : []),
      ["front", "front", null], ["top", "top", null], ["end", "end", null]];
    by("views").replaceChildren(...views.map(([text, from, plant]) => make("button", {
      type: "button", textContent: text, data: { view: from === "free" ? plant ?? "" : from },
      onclick: () => this.look(from, plant) })));
    this.choose(this.chosen ?? null);
  }
  choose(view) {
    this.chosen = view;
    for (const button of by("views").children) button.setAttribute("aria-pressed", String(button.dataset.view === view));
  }

  key(event) {
    const turns = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
    const offset = this.camera.position.clone().sub(this.orbit.target);
    const ball = new THREE.Spherical().setFromVector3(offset);
    if (event.key in turns) {
      ball.theta += 0.12 * turns[event.key][0];
      ball.phi = Math.min(this.orbit.maxPolarAngle, Math.max(0.02, ball.phi + 0.12 * turns[event.key][1]));
    } else if (event.key === "+" || event.key === "-") {
      ball.radius = Math.min(this.orbit.maxDistance, Math.max(this.orbit.minDistance, ball.radius * (event.key === "+" ? 0.85 : 1.18)));
    } else {
      return;
    }
    event.preventDefault();
    this.camera.position.copy(this.orbit.target).add(offset.setFromSpherical(ball));
    this.orbit.update();
    this.choose(null);
  }

  fit() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    const fine = Math.min(2, window.devicePixelRatio);
    this.renderer.setPixelRatio(this.level > 1 ? Math.min(1, 0.75 * fine) : fine);
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const { chosen } = this;
    if (chosen !== null && chosen !== undefined && this.bounds)
      this.look(chosen in directions ? chosen : "free", chosen in directions || chosen === "" ? null : chosen);
    this.stale = true;
  }

  /// Where drawing is slow (no graphics card), less is drawn.
  judge(now) {
    if (this.lastDrawn && now - this.lastDrawn < 250) {
      this.mean = 0.95 * (this.mean ?? 16) + 0.05 * (now - this.lastDrawn);
      this.judged = (this.judged ?? 0) + 1;
    }
    this.lastDrawn = now;
    if (this.mean > slowFrame && this.judged > 60 && this.level < 2) {
      this.level += 1;
      this.judged = 0;
      this.mean = 16;
      this.lamp.castShadow = this.level < 2;
      if (this.level === 2) {
        this.model.traverse((node) => { if (node.isMesh) node.material.needsUpdate = true; });
        this.floor.material.needsUpdate = true;
        this.fit();
      }
    }
  }

  draw(now) {
    requestAnimationFrame((then) => this.draw(then));
    if (this.holder.clientHeight === 0) return;
    if (this.after && !this.settled) {
      const share = Math.min(1, Math.max(0, (performance.now() - this.after.at) / this.interval));
      this.place(share);
      this.settled = share >= 1;
      this.stale = true;
    }
    if (!this.stale || !this.size) return;
    this.stale = false;
    this.renderer.shadowMap.autoUpdate = this.level === 0 || this.frames % 8 === 0;
    this.renderer.render(this.scene, this.camera);
    this.frames += 1;
    this.judge(now);
  }
}
