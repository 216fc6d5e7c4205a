// Simplifies meshes for translucent ghosts: all vertices in one cell of a grid become one vertex.
"use strict";

const Coarse = (() => {
  const FINE = 12000;
  const CELLS = 40;

  function of(geometry) {
    const [places, corners] = [geometry.attributes.position.array, geometry.index.array];
    if (corners.length / 3 <= FINE) return geometry;
    const { min, max } = geometry.boundingBox;
    const cell = Math.max(max.x - min.x, max.y - min.y, max.z - min.z) / CELLS || 1;
    const first = new Map();
    const kept = new Uint32Array(places.length / 3);
    for (let n = 0; n < kept.length; n += 1) {
      const [i, j, k] = [0, 1, 2].map((c) => Math.floor((places[3 * n + c] - [min.x, min.y, min.z][c]) / cell));
      const key = (i * 1024 + j) * 1024 + k;
      if (!first.has(key)) first.set(key, n);
      kept[n] = first.get(key);
    }
    const faces = [];
    for (let n = 0; n < corners.length; n += 3) {
      const [a, b, c] = [kept[corners[n]], kept[corners[n + 1]], kept[corners[n + 2]]];
      if (a !== b && b !== c && c !== a) faces.push(a, b, c);
    }
    const coarse = new THREE.BufferGeometry();
    coarse.setAttribute("position", geometry.attributes.position);
    coarse.setIndex(faces);
    return coarse;
  }

  return { of };
})();
