/* global THREE, Look, Still, Backdrop */
// A machine in 3-D: the parts of a .glb, put where they are told, looked at from all sides. The live page and the
// report use it.
const View = (() => {
"use strict";

const numbersAPart = 10;  // position 3, quaternion 4, scale 3; scale 0: not to be seen
const slowFrame = 45;     // [ms] then it is drawn plainly
const plainFrame = 1000 / 31;  // [ms] from one plain picture to the next
const restAfter = 400;    // [ms] without a change: then there is time for a fine picture
const firstPatience = 30;  // so often a part is shown where it was until it counts as standing still
const directions = {
  free: [0.5, 0.42, 0.85],
  front: [0, 0.12, 1],
  top: [0, 1, 0.001],
  end: [1, 0.15, 0.001],
};

return class View {
  static numbersAPart = numbersAPart;

  /// A part's numbers a share of the way from `a`, at `i`, to `b`, at `j`; into `to`, at `k`.
  static between(a, i, b, j, share, to, k) {
    for (let n = 0; n < 3; ++n) {
      to[k + n] = a[i + n] + share * (b[j + n] - a[i + n]);
      to[k + 7 + n] = a[i + 7 + n] + share * (b[j + 7 + n] - a[i + 7 + n]);
    }
    THREE.Quaternion.slerpFlat(to, k + 3, a, i + 3, b, j + 3, share);
  }

  /// A canvas in `holder`, buttons of the views in `bar`. `before`: called before each picture with the time [ms]; may
  /// put the parts elsewhere. Throws an Error that can be told where it cannot be: no three.js, no WebGL.
  constructor(holder, bar, before) {
    Object.assign(this, { holder, bar, before });
    this.parts = [];
    this.names = [];
    this.frames = 0;  // drawn so far
    this.stale = true;
    this.judged = 0;
    this.due = 0;
    this.chosen = null;
    if (typeof THREE === "undefined") throw new Error("three.js (package libjs-three) is not installed");
    this.stage();
  }

  stage() {
    // What three.js writes to the console about a missing WebGL is said in the page.
    const canvas = document.createElement("canvas");
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", "The machine in 3-D. Arrows turn it, plus and minus come nearer and go away.");
    const slow = Look.isSlow();
    const context = this.contextOf(canvas, { alpha: true, antialias: !slow, powerPreference: "high-performance" });
    this.renderer = new THREE.WebGLRenderer({ canvas, context, alpha: true });
    this.probe = document.createElement("span");
    this.probe.hidden = true;
    this.holder.append(canvas, this.probe);
    this.canvas = canvas;

    this.scene = new THREE.Scene();
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.02, 200);
    this.orbit = new THREE.OrbitControls(this.camera, canvas);
    this.orbit.enableKeys = false;
    this.orbit.maxPolarAngle = Math.PI / 2 - 0.02;
    this.orbit.addEventListener("change", () => this.renew());
    this.orbit.addEventListener("start", () => this.choose(null));
    canvas.addEventListener("keydown", (event) => this.key(event));

    this.still = new Still(this.scene);
    this.backdrop = new Backdrop(this.renderer, this.scene, this.camera);
    this.look = this.newLook(!slow);
    new ResizeObserver(() => this.fit()).observe(this.holder);
    new IntersectionObserver((seen) => { this.inSight = seen.at(-1).isIntersecting; }).observe(this.holder);
    requestAnimationFrame((now) => this.draw(now));
  }

  contextOf(canvas, options) {
    return canvas.getContext("webgl2", options) ?? canvas.getContext("webgl", options);
  }

  newLook(fine) {
    return new Look(this.renderer, this.scene, fine, (name) => {
      this.probe.style.color = `var(--${name})`;
      return getComputedStyle(this.probe).color;
    });
  }

  /// Another picture, of which nothing is as it was.
  renew() {
    this.backdrop.renew();
    this.stale = true;
  }

  /// In the colours of the page as they are now.
  paint() {
    this.look.paint();
    this.renew();
  }

  /// The parts of these names from the bytes of a .glb, in place of those before. False if it was asked for others meanwhile.
  async load(bytes, names) {
    this.loading = bytes;
    const model = await new Promise((done, failed) => new THREE.GLTFLoader().parse(bytes, "", done, failed));
    if (this.loading !== bytes) return false;
    this.still.part();
    if (this.model) this.scene.remove(this.model);
    this.model = model.scene;
    this.look.dress(model.scene);
    // As the loader calls a node: without what its own paths cannot hold.
    const called = (name) => THREE.PropertyBinding.sanitizeNodeName(name);
    const nodes = new Map();
    model.scene.traverse((node) => nodes.set(node.name, node));
    this.parts = names.map((name) => nodes.get(called(name)));
    for (const part of this.parts) if (part) part.matrixAutoUpdate = false;
    this.names = names;
    this.poses = null;
    this.quiet = names.map(() => 0);
    this.patience = this.waits = firstPatience;
    this.scene.add(model.scene);
    this.offerViews();
    this.renew();
    return true;
  }

  /// Puts the parts where these numbers say.
  show(poses) {
    const first = this.poses === null;
    if (first) this.poses = new Float32Array(poses.length).fill(NaN);
    const position = new THREE.Vector3(), scale = new THREE.Vector3(), turn = new THREE.Quaternion();
    this.parts.forEach((part, i) => {
      if (!part) return;
      const at = i * numbersAPart;
      let same = true;
      for (let n = at; n < at + numbersAPart; ++n) {
        same = same && this.poses[n] === poses[n];
        this.poses[n] = poses[n];
      }
      if (same) {
        this.quiet[i] += 1;
        return;
      }
      this.quiet[i] = 0;
      this.stale = true;
      scale.fromArray(poses, at + 7);
      part.visible = scale.x !== 0;
      if (!part.visible) return;
      part.matrix.compose(position.fromArray(poses, at), turn.fromArray(poses, at + 3), scale);
      part.matrixWorldNeedsUpdate = true;
    });
    if (first && !this.bounds) this.view("free", null);
    this.join();
  }

  /// Draws what stands still as one, until a part of it moves; after that it takes its time.
  join() {
    if (this.still.parts.length > 0) {
      if (this.joined.every((i) => this.quiet[i] > 0)) return;
      this.still.part();
      this.backdrop.renew();
      this.waits = this.patience *= 2;
    } else if (--this.waits <= 0) {
      this.joined = [...this.parts.keys()].filter(
        (i) => this.parts[i]?.isMesh && this.parts[i].visible && this.quiet[i] >= firstPatience / 2);
      this.backdrop.renew();
      if (this.joined.length > 1) this.still.join(this.joined.map((i) => this.parts[i]));
      this.waits = this.patience;
    }
  }

  /// The boxes of the parts of a plant, of all if it is null; pieces do not count.
  boxesOf(plant) {
    this.scene.updateMatrixWorld(true);
    const counts = (name) => (plant === null || name.startsWith(plant + ".")) && !/\.(piece|belt mark)/.test(name);
    return this.parts.filter((part, i) => part?.visible && counts(this.names[i])).map((part) => new THREE.Box3().setFromObject(part));
  }

  view(from, plant) {
    if (!this.poses) return;
    const around = (boxes) => boxes.reduce((all, box) => all.union(box), new THREE.Box3());
    const everything = this.boxesOf(null);
    if (everything.length === 0) return;
    const all = around(everything);
    this.bounds = all;
    this.look.furnish(all);
    const own = plant === null ? [] : this.boxesOf(plant);
    const boxes = own.length > 0 ? own : everything;
    const way = new THREE.Vector3(...directions[from]).normalize();
    // As near as all corners are inside the picture.
    const half = Math.tan(THREE.Math.degToRad(this.camera.fov / 2));
    const right = new THREE.Vector3().crossVectors(new THREE.Vector3(0, 1, 0), way).normalize();
    const up = new THREE.Vector3().crossVectors(way, right);
    const { center: centre, radius } = around(boxes).getBoundingSphere(new THREE.Sphere());
    let far = 0.2 * radius;
    for (const { min, max } of boxes)
      for (const x of [min.x, max.x]) for (const y of [min.y, max.y]) for (const z of [min.z, max.z]) {
        const corner = new THREE.Vector3(x, y, z).sub(centre);
        const wide = Math.abs(corner.dot(right)) / this.camera.aspect;
        far = Math.max(far, corner.dot(way) + (1.1 / half) * Math.max(wide, Math.abs(corner.dot(up))));
      }
    this.orbit.target.copy(centre);
    this.camera.position.copy(centre).addScaledVector(way, far);
    this.orbit.minDistance = 0.1 * radius;
    this.orbit.maxDistance = 6 * this.look.size;
    this.orbit.update();
    this.choose(from === "free" ? plant ?? "" : from);
    this.renew();
  }

  offerViews() {
    const plants = [...new Set(this.names.map((name) => name.split(".")[0]))];
    const views = [["whole line", "free", null], ...(plants.length > 1 ? plants.map((name) => [name, "free", name]) : []),
      ["front", "front", null], ["top", "top", null], ["end", "end", null]];
    this.bar.replaceChildren(...views.map(([text, from, plant]) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: text, onclick: () => this.view(from, plant) });
      button.dataset.view = from === "free" ? plant ?? "" : from;
      return button;
    }));
    this.choose(this.chosen);
  }
  choose(view) {
    this.chosen = view;
    for (const button of this.bar.children) button.setAttribute("aria-pressed", String(button.dataset.view === view));
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
    this.fineness(false);
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    const { chosen } = this;
    if (chosen !== null && this.bounds)
      this.view(chosen in directions ? chosen : "free", chosen in directions || chosen === "" ? null : chosen);
    this.renew();
  }

  /// Pixels of the picture: the screen's, and more where a plain one stands still.
  fineness(resting) {
    if (this.resting === resting) return;
    this.resting = resting;
    this.backdrop.renew();
    const screen = Math.min(2, window.devicePixelRatio);
    this.renderer.setPixelRatio(resting ? 2 : this.look.fine ? screen : 1);
  }

  /// Where the fine look is too much, the plain one is taken.
  judge(now) {
    if (this.look.fine && this.lastDrawn && now - this.lastDrawn < 250) {
      this.mean = 0.95 * (this.mean ?? 16) + 0.05 * (now - this.lastDrawn);
      if (++this.judged > 90 && this.mean > slowFrame) this.plain();
    }
    this.lastDrawn = now;
  }
  plain() {
    this.still.part();
    this.look.go();
    this.look = this.newLook(false);
    this.look.dress(this.model);
    this.resting = undefined;
    this.fineness(false);
    this.look.furnish(this.bounds);
  }

  draw(now) {
    requestAnimationFrame((then) => this.draw(then));
    if (this.holder.clientHeight === 0 || this.inSight === false) return;
    if (!this.look.fine && now < this.due - 4) return;
    this.before?.(now);
    if (!this.bounds) return;
    const rested = !this.stale && !this.look.fine && !this.resting && now - this.lastDrawn > restAfter;
    if (!this.stale && !rested) return;
    // A picture that comes late is followed by one in time.
    this.due = Math.max(this.due + plainFrame, now);
    this.stale = false;
    this.fineness(rested);
    this.backdrop.draw(!this.look.fine && !rested && this.still.parts.length > 0);
    this.frames += 1;
    this.judge(now);
  }
};
})();
