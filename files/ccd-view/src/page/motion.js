// Poses of bodies at a time: a translation and a rotation matrix, by exact formulas or between keyframes.
"use strict";

const Motion = (() => {
  const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1];

  const apply = (m, [x, y, z]) => [0, 3, 6].map((r) => m[r] * x + m[r + 1] * y + m[r + 2] * z);

  const product = (m, n) => [0, 3, 6].flatMap((r) => [0, 1, 2].map((c) => m[r] * n[c] + m[r + 1] * n[c + 3] + m[r + 2] * n[c + 6]));

  // The rotation by a rotation vector (Rodrigues).
  function turn(vector) {
    const angle = Math.hypot(...vector);
    if (!(angle > 0)) return IDENTITY;
    const [x, y, z] = vector.map((component) => component / angle);
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    const d = 1 - c;
    return [
      c + d * x * x, d * x * y - s * z, d * x * z + s * y,
      d * x * y + s * z, c + d * y * y, d * y * z - s * x,
      d * x * z - s * y, d * y * z + s * x, c + d * z * z,
    ];
  }

  // x(t) = exp(t[ω]) R₀ (x − c) + C₀ + v t.
  function steady({ center, from, velocity, spin, rotation }, t) {
    const turned = product(turn(spin.map((w) => w * t)), rotation);
    const back = apply(turned, center);
    return { rotation: turned, place: from.map((p, k) => p + velocity[k] * t - back[k]) };
  }

  // Between two keyframes the center moves in a straight line, and the first keyframe's rotation vector gives the rotation.
  function keyed({ center, keys }, t) {
    let next = keys.findIndex((key) => key.time > t);
    if (next < 0) next = keys.length - 1;
    const [one, two] = [keys[Math.max(next - 1, 0)], keys[next]];
    const fraction = two.time > one.time ? Math.min(Math.max((t - one.time) / (two.time - one.time), 0), 1) : 0;
    const way = one.turn;
    const rotation = product(turn(way.map((w) => w * fraction)), one.rotation);
    const back = apply(rotation, center);
    return { rotation, place: one.place.map((p, k) => p + fraction * (two.place[k] - p) - back[k]) };
  }

  const moves = ({ keys, velocity, spin }) => (keys
    ? keys.some(({ place, turn }, k) => k + 1 < keys.length && (Math.hypot(...turn) > 0 || String(place) !== String(keys[k + 1].place)))
    : Math.hypot(...velocity, ...spin) > 0);

  const pose = (motion, t) => (motion.keys ? keyed(motion, t) : steady(motion, t));

  return { pose, apply, moves };
})();

if (typeof module !== "undefined") module.exports = Motion;
