// Compares the package with native answers to the same queries: times of queries, loading time, sizes.
//
//   cargo run --release -p rigid-ccd-js -- target/js
//   taskset -c 1 cargo run --release -p rigid-ccd-js --example native-queries >target/queries.json
//   taskset -c 1 node doors/js/bench/bench.mjs target/queries.json [PAGE.html]
//
// With PAGE it also writes a page that measures the same. `chromium --headless --no-sandbox --dump-dom PAGE.html` prints the table.

import { readFile, writeFile } from "node:fs/promises";
import { performance } from "node:perf_hooks";
import { argv } from "node:process";
import { gzipSync } from "node:zlib";
import { compare } from "./compare.mjs";

const FOLDER = new URL("../../../target/js/", import.meta.url);

async function main() {
  const queries = JSON.parse(await readFile(argv[2], "utf8"));
  const module = await readFile(new URL("rigid-ccd.js", FOLDER));
  console.log(`module: ${module.length} bytes, ${gzipSync(module, { level: 9 }).length} by gzip`);
  for (const simd of [true, false]) {
    const loads = [];
    let ccd = null;
    for (let k = 0; k < 9; k += 1) {
      const begun = performance.now();
      ccd = await import(new URL(`rigid-ccd.js?${simd}${k}`, FOLDER));
      await ccd.init({ simd });
      loads.push((performance.now() - begun).toFixed(0));
    }
    console.log(`${simd ? "with" : "without"} vectors: loaded in ${loads.join(", ")} ms`);
    for (const line of compare(ccd, queries, performance)) console.log(line);
  }
  if (argv[3]) await writeFile(argv[3], await page(module.toString(), queries));
}

async function page(module, queries) {
  const compared = await readFile(new URL("compare.mjs", import.meta.url), "utf8");
  const texts = JSON.stringify({ module, compared, queries }).replaceAll("<", "\\u003c");
  // A document that is still being written delays the event `load`. A headless browser waits for that event.
  return `<!doctype html><meta charset="utf-8"><pre></pre><iframe hidden></iframe>
<script>const held = document.querySelector("iframe").contentDocument; held.open();</script>
<script type="module">
const { module, compared, queries } = ${texts};
const load = (text) => import(URL.createObjectURL(new Blob([text], { type: "text/javascript" })));
const { compare } = await load(compared);
const begun = performance.now();
const ccd = await load(module);
await ccd.init();
const loaded = \`loaded in \${(performance.now() - begun).toFixed(1)} ms\`;
document.querySelector("pre").textContent = [loaded, ...compare(ccd, queries, performance)].join("\\n");
for (const script of document.querySelectorAll("script")) script.remove();
held.close();
</script>`;
}

await main();
