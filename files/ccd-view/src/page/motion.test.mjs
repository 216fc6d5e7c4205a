// Poses against a twin of quaternions: node --test motion.test.mjs
import assert from "node:assert";
import { createRequire } from "node:module";
import test from "node:test";

const Motion = createRequire(import.meta.url)("./motion.js");

const times = ([a, b, c, d], [e, f, g, h]) => [a * e - b * f - c * g - d * h, a * f + b * e + c * h - d * g, a * g - b * h + c * e + d * f, a * h + b * g - c * f + d * e];
const rotated = (q, v) => times(times(q, [0, ...v]), [q[0], -q[1], -q[2], -q[3]]).slice(1);

function quaternion(vector) {
  const angle = Math.hypot(...vector);
  const s = angle > 0 ? Math.sin(angle / 2) / angle : 0.5;
  return [Math.cos(angle / 2), ...vector.map((v) => v * s)];
}

function rows(q) {
  const columns = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((axis) => rotated(q, axis));
  return [0, 1, 2].flatMap((r) => columns.map((column) => column[r]));
}

let seed = 1;
const random = () => { seed = (seed * 48271) % 2147483647; return (2 * seed) / 2147483647 - 1; };
const vector = (size) => [size * random(), size * random(), size * random()];
const near = (a, b, size = 1) => a.forEach((x, k) => assert.ok(Math.abs(x - b[k]) <= 1e-9 * size, `${a} ${b}`));

test("constant velocities", () => {
  for (let n = 0; n < 500; n += 1) {
    const [center, from, velocity, spin, turn, point, t] = [vector(2), vector(5), vector(3), vector(n % 7), vector(3), vector(1), 2 * random()];
    const start = quaternion(turn);
    const { rotation, place } = Motion.pose({ center, from, velocity, spin, rotation: rows(start) }, t);
    const moved = rotated(times(quaternion(spin.map((w) => w * t)), start), point.map((p, k) => p - center[k])).map((p, k) => p + from[k] + velocity[k] * t);
    near(Motion.apply(rotation, point).map((p, k) => p + place[k]), moved, 10);
  }
});

test("between keys, by their turns", () => {
  for (let n = 0; n < 500; n += 1) {
    const [center, start, way, from, to] = [vector(2), quaternion(vector(3)), vector(1.8), vector(4), vector(4)];
    if (n === 0) way.splice(0, 3, Math.PI, 0, 0);
    if (n === 1) way.fill(0);
    const keys = [[1, start, from], [3, times(quaternion(way), start), to]].map(([time, q, place]) => ({ time, rotation: rows(q), place, turn: way }));
    const fraction = Math.abs(random());
    const { rotation, place } = Motion.pose({ center, keys }, 1 + 2 * fraction);
    // The center moves straight.
    near(Motion.apply(rotation, center).map((p, k) => p + place[k]), from.map((p, k) => p + fraction * (to[k] - p)), 10);
    const expected = rows(times(quaternion(way.map((w) => w * fraction)), start));
    near(rotation, expected);
  }
  const keys = [0, 1, 2].map((time) => ({ time, rotation: rows([1, 0, 0, 0]), place: [time, 0, 0], turn: [0, 0, 0] }));
  for (const [t, x] of [[-1, 0], [0, 0], [1, 1], [1.5, 1.5], [2, 2], [9, 2]]) near(Motion.pose({ center: [0, 0, 0], keys }, t).place, [x, 0, 0]);
});

test("what moves", () => {
  const steady = (velocity, spin) => Motion.moves({ velocity, spin });
  assert.deepEqual([steady([0, 0, 0], [0, 0, 0]), steady([0, 1e-300, 0], [0, 0, 0]), steady([0, 0, 0], [0, 0, -1])], [false, true, true]);
  const keyed = (...keys) => Motion.moves({ keys: keys.map(([place, turn]) => ({ place, turn })) });
  const [here, there, still, turns] = [[1, 2, 3], [1, 2, 4], [0, 0, 0], [0, 0, 1]];
  assert.deepEqual([keyed([here, still], [here, still]), keyed([here, still], [there, still]), keyed([here, turns], [here, still])], [false, true, true]);
  // Nothing follows the last key.
  assert.equal(keyed([here, still], [here, turns]), false);
});
