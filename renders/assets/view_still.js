/* global THREE, Backdrop */
// Parts that stand still are drawn as one: a picture costs by the number of its parts.
const Still = (() => {
"use strict";

const drawn = 0, notDrawn = 1;  // layers of three.js

return class Still {
  constructor(scene) {
    this.scene = scene;
    this.parts = [];
    this.meshes = [];
  }

  /// Draws these parts, meshes that stand in the scene, as one for each material.
  join(parts) {
    this.scene.updateMatrixWorld(true);
    this.parts = parts;
    const groups = new Map();
    for (const part of parts) {
      if (!groups.has(part.material)) groups.set(part.material, []);
      groups.get(part.material).push(part);
      part.layers.set(notDrawn);
    }
    for (const [material, group] of groups) {
      const mesh = new THREE.Mesh(joined(group), material);
      Object.assign(mesh, { castShadow: group[0].castShadow, receiveShadow: group[0].receiveShadow, frustumCulled: false });
      mesh.layers.set(Backdrop.standing);
      this.meshes.push(mesh);
      this.scene.add(mesh);
    }
  }

  /// Each by itself again.
  part() {
    for (const part of this.parts) part.layers.set(drawn);
    for (const mesh of this.meshes) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
    }
    this.parts = [];
    this.meshes = [];
  }
};

function joined(parts) {
  const corners = parts.map((part) => part.geometry.attributes.position.count);
  const indexes = parts.map((part) => part.geometry.index.count);
  const sum = (counts) => counts.reduce((all, count) => all + count, 0);
  const arrays = { position: new Float32Array(3 * sum(corners)), normal: new Float32Array(3 * sum(corners)), color: new Float32Array(3 * sum(corners)) };
  const index = new Uint32Array(sum(indexes));
  const point = new THREE.Vector3();
  let corner = 0, at = 0;
  parts.forEach((part, i) => {
    const { position, normal, color } = part.geometry.attributes;
    const normals = new THREE.Matrix3().getNormalMatrix(part.matrixWorld);
    for (let k = 0; k < corners[i]; ++k) {
      point.fromBufferAttribute(position, k).applyMatrix4(part.matrixWorld).toArray(arrays.position, 3 * (corner + k));
      point.fromBufferAttribute(normal, k).applyMatrix3(normals).normalize().toArray(arrays.normal, 3 * (corner + k));
      point.fromBufferAttribute(color, k).toArray(arrays.color, 3 * (corner + k));
    }
    for (let k = 0; k < indexes[i]; ++k) index[at + k] = corner + part.geometry.index.getX(k);
    corner += corners[i];
    at += indexes[i];
  });
  const geometry = new THREE.BufferGeometry();
  for (const [name, array] of Object.entries(arrays)) geometry.setAttribute(name, new THREE.BufferAttribute(array, 3));
  geometry.setIndex(new THREE.BufferAttribute(index, 1));
  return geometry;
}
})();
