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
await ccd.init();
for (const cases of [bodies, questions, mechanisms]) {
  for (const [name, run] of Object.entries(cases(ccd, check))) test(name, run);
}

test("another instance gives the same bits", async () => {
  const other = await import(`${MODULE}?other`);
  await Promise.all([other.init(), other.init()]);
  const [one, two] = [ccd, other].map((module) => answers(module, check.randomNumbers));
  check.equal(one.text, two.text);
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

test("without vectors it says what is needed", async () => {
  const { validate } = WebAssembly;
  const old = await import(`${MODULE}?old`);
  WebAssembly.validate = () => false;
  const error = await old.init().catch((caught) => caught);
  WebAssembly.validate = validate;
  check.ok(/128-bit vectors/.test(error.message), String(error));
  await old.init();
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
