// The parts that are thrown, and what is asked about a throw of one at another, which rests at the world's origin.
"use strict";

const Parts = (() => {
  // Of every throw, in seconds.
  const DURATION = 1;
  // The distance, in metres, at which parts count as touching.
  const TOLERANCE = 1e-6;
  const text = (id) => document.getElementById(id).textContent;
  const known = JSON.parse(text("parts"));
  let ccd = null;

  async function load() {
    ccd = await import(URL.createObjectURL(new Blob([text("engine")], { type: "text/javascript" })));
    await ccd.init();
  }

  function named(name) {
    const { shape, vertices, faces } = known[name];
    const [kind, ...lengths] = shape;
    const drawn = [new Float32Array(vertices), new Uint32Array(faces)];
    return part(kind === "mesh" ? ccd.Body.fromMesh(...drawn) : ccd.Body[kind](...lengths), ...drawn);
  }

  // Reads a mesh, and scales it to a size around its centre.
  function fromFile(name, bytes, size) {
    const { positions, indices } = ccd.readMesh(name, bytes);
    const axes = [0, 1, 2].map((axis) => positions.filter((_, k) => k % 3 === axis));
    const low = axes.map((places) => places.reduce((a, b) => Math.min(a, b)));
    const sides = axes.map((places, axis) => places.reduce((a, b) => Math.max(a, b)) - low[axis]);
    const scale = size / Math.hypot(...sides);
    const scaled = positions.map((place, k) => scale * (place - low[k % 3] - 0.5 * sides[k % 3]));
    return part(ccd.Body.fromMesh(scaled, indices), new Float32Array(scaled), indices);
  }

  // A body with the triangles that are drawn; `reach` is how far they are from its origin.
  function part(body, vertices, faces) {
    let reach = 0;
    for (let k = 0; k < vertices.length; k += 3) reach = Math.max(reach, Math.hypot(vertices[k], vertices[k + 1], vertices[k + 2]));
    return { body, vertices, faces, reach };
  }

  function firstContact(thrown, target, motion) {
    const answer = ccd.firstContact(thrown.body, target.body, { motionA: motion, duration: DURATION, tolerance: TOLERANCE });
    const { kind, time, safeUntil, witnessA = [], witnessB = [], normal } = answer;
    return { verdict: kind, time: time ?? safeUntil ?? DURATION, points: [...witnessA, ...witnessB, ...(normal ?? [])] };
  }

  // Whether they touch at evenly spaced times, from the start to the end: 1 if they do, 0 if not.
  function steps(thrown, target, motion, count) {
    const moved = new ccd.Motion(motion);
    const touches = Array.from({ length: count + 1 }, (_, step) => {
      const motionA = moved.pose((DURATION * step) / count);
      return Number(ccd.firstContact(thrown.body, target.body, { motionA, duration: 0, tolerance: TOLERANCE }).kind !== "free");
    });
    moved.free();
    return touches;
  }

  return { DURATION, load, named, fromFile, firstContact, steps };
})();
