// Writes a page that runs the cases in a browser: `node doors/js/test/page.mjs target/js-test.html`. Faults go to the console.

import { readFile, writeFile } from "node:fs/promises";
import { argv } from "node:process";

const CASES = ["arguments", "bodies", "questions", "mechanisms"];

const here = (name) => readFile(new URL(name, import.meta.url), "utf8");
const texts = { module: await here("../../../target/js/rigid-ccd.js"), fallback: await here("../../../target/js/fallback.js") };
for (const name of ["check", "random_answers", ...CASES]) texts[name] = await here(`${name}.mjs`);

// Escapes `<`, which could begin the end tag of the script.
const json = JSON.stringify(texts).replaceAll("<", "\\u003c");
await writeFile(
  argv[2],
  `<!doctype html>
<html lang="en">
<meta charset="utf-8">
<link rel="icon" href="data:,">
<title>rigid-ccd in a browser</title>
<pre></pre>
<iframe hidden></iframe>
<script>
// A document that is still being written delays the event \`load\`. A headless browser waits for that event.
const held = document.querySelector("iframe").contentDocument;
held.open();
</script>
<script type="module">
const texts = ${json};
const addressOf = (text) => URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
const load = (text) => import(addressOf(text));
// A module from an object URL has no folder, so the path of the fallback is replaced.
const module = texts.module.replace('"./fallback.js"', JSON.stringify(addressOf(texts.fallback)));
const lines = [];
// Remarks are not failures.
console.warn = (text) => lines.push(text);
async function run() {
  const check = await load(texts.check);
  const { answers } = await load(texts.random_answers);
  const found = [];
  for (const simd of [true, false]) {
    const ccd = await load(module);
    check.equal(await ccd.init(simd ? undefined : { simd }), { simd });
    for (const name of ${JSON.stringify(CASES)}) {
      for (const [title, test] of Object.entries((await load(texts[name])).default(ccd, check))) {
        test();
        lines.push(\`\${simd ? "with" : "without"} vectors: \${title}\`);
      }
    }
    found.push(answers(ccd, check.randomNumbers).text);
  }
  check.equal(found[0], found[1]);
  document.documentElement.dataset.tested = "drawn";
}
await run().catch((error) => console.error(\`after "\${lines.at(-1)}": \${error.stack}\`));
document.querySelector("pre").textContent = lines.join("\\n");
held.close();
</script>
</html>
`,
);
