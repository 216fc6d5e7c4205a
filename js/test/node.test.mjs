// Runs the cases in node, with the package in `target/js`.

import { readFile } from "node:fs/promises";
import test from "node:test";
import { setTimeout } from "node:timers/promises";
import { setFlagsFromString } from "node:v8";
import { runInNewContext } from "node:vm";
import bodies from "./bodies.mjs";
import * as check from "./check.mjs";
import mechanisms from "./mechanisms.mjs";
import questions from "./questions.mjs";
import { answers } from "./random_answers.mjs";

const MODULE = new URL("../../target/js/rigid-ccd.js", import.meta.url);

const unloaded = await import(`${MODULE}?unloaded`);
test("nothing works before init", () => {
  check.throws(() => unloaded.Body.sphere(1), /await init\(\)/);
  check.throws(() => unloaded.firstContact(null, null), /await init\(\)/);
});

const ccd = await import(MODULE);
const scalar = await import(`${MODULE}?scalar`);
check.equal([await ccd.init(), await scalar.init({ simd: false })], [{ simd: true }, { simd: false }]);
for (const [module, suffix] of [[ccd, ""], [scalar, ", without vectors"]]) {
  for (const cases of [bodies, questions, mechanisms]) {
    for (const [name, run] of Object.entries(cases(module, check))) test(name + suffix, run);
  }
}

test("another instance, and one without vectors, give the same bits", async () => {
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

/** Returns the error of an init, which has to have one. */
async function refused(init) {
  const error = await init.then(() => null, (caught) => caught);
  check.ok(error instanceof Error, "nothing is refused");
  return error.message;
}

test("an engine without vectors loads the other module, unless they are asked for", async () => {
  const { validate } = WebAssembly;
  const old = await import(`${MODULE}?old`);
  WebAssembly.validate = () => false;
  const message = await refused(old.init({ simd: true }));
  const loaded = await old.init();
  WebAssembly.validate = validate;
  check.ok(/^simd: .*128-bit vectors/.test(message), message);
  check.equal([loaded, await old.init()], [{ simd: false }, { simd: false }]);
  check.ok(/without vector instructions is loaded already/.test(await refused(old.init({ simd: true }))), "what is loaded stays");
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
