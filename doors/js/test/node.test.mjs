// Runs the cases in node, with the package in `target/js`.

import { existsSync } from "node:fs";
import { readFile } from "node:fs/promises";
import test from "node:test";
import { setTimeout } from "node:timers/promises";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import arguments_ from "./arguments.mjs";
import bodies from "./bodies.mjs";
import * as check from "./check.mjs";
import mechanisms from "./mechanisms.mjs";
import questions from "./questions.mjs";
import { answers } from "./random_answers.mjs";

const MODULE = new URL("../../../target/js/rigid-ccd.js", import.meta.url);
const hasFallback = existsSync(new URL("fallback.js", MODULE));
/** Options of tests that need the module without vector instructions. */
const ofFallback = hasFallback ? {} : { skip: "the package was built without its fallback" };

const unloaded = await import(`${MODULE}?unloaded`);
test("nothing works before init", () => {
  check.throws(() => unloaded.Body.sphere(1), /await init\(\)/);
  check.throws(() => unloaded.firstContact(null, null), /await init\(\)/);
});

const ccd = await import(MODULE);
check.equal(await ccd.init(), { simd: true });
const scalar = hasFallback ? await import(`${MODULE}?scalar`) : null;
if (hasFallback) check.equal(await scalar.init({ simd: false }), { simd: false });
for (const [module, suffix] of [[ccd, ""], ...(hasFallback ? [[scalar, ", without vectors"]] : [])]) {
  for (const cases of [arguments_, bodies, questions, mechanisms]) {
    for (const [name, run] of Object.entries(cases(module, check))) test(name + suffix, run);
  }
}

test("another instance, and one without vectors, give the same bits", ofFallback, async () => {
  const other = await import(`${MODULE}?other`);
  await Promise.all([other.init(), other.init()]);
  const [one, ...others] = [ccd, other, scalar].map((module) => answers(module, check.randomNumbers));
  for (const { text } of others) check.equal(one.text, text);
  for (const kind of ["free", "contact", "interval", "leastDistance"]) check.ok(one.kinds.has(kind), `none is ${kind}`);
});

test("what is collected as garbage is freed", async () => {
  setFlagsFromString("--expose-gc");
  const collect = runInNewContext("gc");
  const round = async () => {
    for (let k = 0; k < 300; k += 1) ccd.Body.cylinder(1, 1);
    collect();
    await setTimeout(50);
  };
  for (let k = 0; k < 3; k += 1) await round();
  const before = ccd.memoryUsage();
  for (let k = 0; k < 9; k += 1) await round();
  check.equal(ccd.memoryUsage(), before);
});

/** Returns the error of a call, which must fail. */
function errorOf(call) {
  try {
    call();
  } catch (error) {
    return error;
  }
  throw new Error(`nothing is thrown by ${call}`);
}

/** Loads a copy of the module. Returns it with the memory of its engine, and the exports to be called. */
async function withMemory(copy, exportsOf = (exports) => exports) {
  const { instantiate } = WebAssembly;
  let memory = null;
  WebAssembly.instantiate = async (...values) => {
    const { exports } = await instantiate(...values);
    ({ memory } = exports);
    return { exports: exportsOf(exports) };
  };
  const module = await import(`${MODULE}?${copy}`);
  await module.init();
  WebAssembly.instantiate = instantiate;
  return { module, memory };
}

test("at the end of its memory the engine ends with a typed error, and another one begins", async () => {
  const { module, memory } = await withMemory("memory");
  const [ball, motion] = [module.Body.sphere(1), new module.Motion({ velocity: [1, 0, 0] })];
  // Takes the remaining memory without using it.
  memory.grow(65536 - memory.buffer.byteLength / 65536);
  const mesh = Float64Array.from({ length: 900000 }, (_, k) => ((k * 7919) % 1000) / 1000 + k);
  const error = errorOf(() => module.Body.fromMesh(mesh));
  check.ok(error instanceof module.EngineError && error.reason === "memory", String(error));
  check.ok(/memory of the WebAssembly is exhausted at 4294967296 bytes/.test(error.message), error.message);
  for (const call of [() => module.firstContact(ball, ball), () => ball.report, () => motion.pose(1), () => module.Body.sphere(1), () => module.memoryUsage()]) {
    check.ok(errorOf(call) === error, `${call}`);
  }
  check.equal(await module.init(), { simd: true });
  for (const old of [() => module.firstContact(ball, ball), () => motion.pose(1), () => ball.report]) check.ok(errorOf(old) === error, `${old}`);
  ball.free();
  const fresh = module.Body.sphere(1);
  check.equal(module.firstContact(fresh, fresh, { motionA: { position: [5, 0, 0] } }).kind, "free");
  check.ok(module.memoryUsage() < 2 ** 26, "the memory is a new one");
});

test("too deep a stack ends the engine with a typed error, and another one begins", async () => {
  const { module } = await withMemory("stack");
  let bodies = [module.Body.sphere(0.5), module.Body.box([1, 1, 1])];
  const ask = () => module.firstContact(...bodies, { motionA: { position: [3, 0, 0], velocity: [-2, 0, 0] } }).kind;
  const deep = (levels) => (levels > 0 ? deep(levels - 1) : ask());
  let ends = 0;
  for (let levels = 1000; levels < 20000; levels += 1) {
    try {
      deep(levels);
    } catch {
      // The stack may be full before the engine is asked.
    }
    if (levels % 500 !== 0) continue;
    try {
      check.equal(ask(), "contact");
    } catch (error) {
      check.ok(error instanceof module.EngineError && error.reason === "fault", String(error));
      ends += 1;
      await module.init();
      bodies = [module.Body.sphere(0.5), module.Body.box([1, 1, 1])];
      check.equal(ask(), "contact");
    }
  }
  check.ok(ends > 0, "the stack was never full within the engine");
});

test("a fault of the engine says so", async () => {
  const { module } = await withMemory("fault", (exports) => {
    const fails = () => {
      throw new WebAssembly.RuntimeError("memory access out of bounds");
    };
    return Object.fromEntries(Object.entries(exports).map(([name, one]) => [name, name === "body_capsule" ? fails : one]));
  });
  const error = errorOf(() => module.Body.capsule(1, 1));
  check.equal([error.name, error.reason], ["EngineError", "fault"]);
  check.ok(errorOf(() => module.Body.sphere(1)) === error, "nothing is asked of it any more");
});

test("what is probably a mistake is said once in the console", async () => {
  const { warn } = console;
  const said = [];
  console.warn = (text) => said.push(text);
  const module = await import(`${MODULE}?remarks`);
  await module.init();
  const { Body, firstContact, Motion, Robot } = module;
  const [grain, ball] = [Body.sphere(1e-4), Body.sphere(1)];
  const far = { position: [9, 0, 0] };
  const hinge = { type: "revolute", name: "hinge", parent: "frame", child: "leaf" };
  const robot = new Robot({ joints: [hinge], bodies: { leaf: ball } });
  for (let k = 0; k < 2; k += 1) {
    firstContact(ball, ball, { motionA: { ...far, rotation: [0, 0, 0, 1], angularVelocity: [0, 0, 6.28] } });
    check.equal(said.length, 4 * k);
    firstContact(grain, ball, { motionA: far });
    firstContact(ball, ball, { motionA: { ...far, angularVelocity: [0, 0, 90] } });
    firstContact(ball, ball, { motionA: new Motion({ ...far, rotation: [0, 0, 0, 2] }) });
    robot.linkTrajectory("leaf", [0], [90]);
  }
  check.equal(said.length, 4);
  const { Cell } = module;
  const cell = new Cell(robot);
  for (let k = 0; k < 2; k += 1) {
    cell.addObstacle(`wall ${k}`, Body.box([1, 50, 50]), { position: [9, 0, 0] });
    cell.isFree([[0], [6.28]]);
    check.equal(said.length, 4 + k);
    // Warnings of these kinds were already shown.
    cell.isFree([[0], [90]], { tolerance: 1 });
    cell.addObstacle(`desk ${k}`, Body.box([1200, 800, 750]), { position: [9000, 0, 0] });
  }
  cell.attach("tool", Body.sphere(0.0005), "leaf", { pose: { position: [0, 0, 2] } });
  console.warn = warn;
  check.equal(said.length, 7);
  for (const [k, pattern] of [/desk 0 is 2400 long, and the robot 2$/, /desk 1 is 2400/, /tool is 0.001 long/].entries()) check.ok(pattern.test(said[4 + k]), said[4 + k]);
  for (const [k, pattern] of [/tolerance is large/, /angular velocity is a round number of degrees/, /is it x, y, z, w\?: \(0, 0, 0, 2\)/, /joint's position/].entries()) {
    check.ok(said[k].startsWith("rigid-ccd: ") && pattern.test(said[k]), said[k]);
  }
});

test("a mesh that is probably a mistake is said once in the console", async () => {
  const { warn } = console;
  const said = [];
  console.warn = (text) => said.push(text);
  const module = await import(`${MODULE}?meshes`);
  await module.init();
  const { Body } = module;
  // Flat meshes and declared surfaces give no warning, because they have no inside.
  const corners = [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1];
  const dae = (unit) => `<COLLADA version="1.4.1"><asset>${unit}</asset><library_geometries><geometry><mesh><source id="s"><float_array id="a">${corners.join(" ")}</float_array><technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="4"><input semantic="VERTEX" source="#v"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries></COLLADA>`;
  const file = (unit, options) => Body.fromFile("part.dae", new TextEncoder().encode(dae(unit)), options);
  Body.fromMesh(corners, [0, 1, 2]);
  Body.fromMesh(corners, [0, 1, 2, 0, 1, 3], { surface: true });
  Body.fromMesh(corners, [0, 1, 2, 0, 1, 3], { pieces: "outer-hull" });
  file("");
  file('<unit meter="1"/>');
  file('<unit meter="0.001"/>', { unit: "m" });
  check.equal(said, []);
  for (let k = 0; k < 2; k += 1) {
    Body.fromMesh(corners, [0, 1, 2, 0, 1, 3]);
    Body.fromMesh([...corners, -1e-16, 0, 0], [0, 2, 1, 4, 1, 3, 4, 3, 2, 1, 2, 3]);
    Body.fromMesh(new Float32Array(36));
    file('<unit meter="0.001"/>');
    module.readMesh("part.dae", new TextEncoder().encode(dae('<unit meter="0.0254"/>')));
  }
  console.warn = warn;
  const patterns = [/not closed: it is a surface, and another body inside it is not found.*: 4 edges/, /by no more than rounding.*up to 1\.0e-16 apart.*mergeVertices/, /all vertices of a mesh are at one point/, /unit that is not the metre.*: mm$/];
  check.equal(said.length, patterns.length);
  for (const [k, pattern] of patterns.entries()) check.ok(pattern.test(said[k]), said[k]);
});

/** Returns the error of an init, which must fail. */
async function refused(init) {
  const error = await init.then(() => null, (caught) => caught);
  check.ok(error instanceof Error, "nothing is refused");
  return error.message;
}

test("an engine without vectors loads the other module, unless they are asked for", ofFallback, async () => {
  const { validate } = WebAssembly;
  const old = await import(`${MODULE}?old`);
  WebAssembly.validate = () => false;
  const message = await refused(old.init({ simd: true }));
  const loaded = await old.init();
  WebAssembly.validate = validate;
  check.ok(/^simd: .*128-bit vectors/.test(message), message);
  check.equal([loaded, await old.init()], [{ simd: false }, { simd: false }]);
  check.ok(/without vector instructions is already loaded/.test(await refused(old.init({ simd: true }))), "what is loaded stays");
  check.ok(/options of init: there is no "vectors"/.test(await refused(old.init({ vectors: true }))), "options are checked");
});

test("one file alone needs vectors, and says which file is missing", async () => {
  const text = await readFile(MODULE, "base64");
  const alone = await import(`data:text/javascript;base64,${text}`);
  const message = await refused(alone.init({ simd: false }));
  check.ok(/needs its file fallback\.js/.test(message), message);
  check.equal(await alone.init(), { simd: true });
});

test("an engine that cannot unpack loads the module all the same", async () => {
  const { DecompressionStream } = globalThis;
  delete globalThis.DecompressionStream;
  const unpacking = await import(`${MODULE}?unpacking`);
  const loaded = await unpacking.init();
  globalThis.DecompressionStream = DecompressionStream;
  check.equal([loaded, unpacking.Body.sphere(1).isSolid], [{ simd: true }, true]);
});

test("the blocks of the README run", async () => {
  const readme = await readFile(new URL("../README.md", import.meta.url), "utf8");
  const blocks = [...readme.matchAll(/^```js\n(.*?)^```$/gms)].map(([, block]) => block);
  check.ok(blocks.length > 0, "the README shows nothing");
  for (const block of blocks) {
    const code = block.replace('"rigid-ccd"', JSON.stringify(MODULE.href));
    await import(`data:text/javascript,${encodeURIComponent(code)}`);
  }
});
