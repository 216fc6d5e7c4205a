// Checks the page in the browser that shows it: its answers, and a throw by pointer.
"use strict";

(async () => {
  await Workshop.ready;
  const page = document.documentElement.dataset;
  const { named } = wasm_bindgen.Part;

  // The answers of the machine that wrote the page. Times may differ in their last bits, as docs/building.md says.
  const ROUNDING = 1e-14;
  const wrong = [];
  const answers = JSON.parse(document.getElementById("answers").textContent);
  for (const [row, answer] of answers.entries()) {
    const [part, target] = [named(answer.part), named(answer.target)];
    const numbers = new Float64Array(answer.throw);
    const found = wasm_bindgen.first_contact(part, target, numbers);
    const seen = wasm_bindgen.steps(part, target, numbers, answer.steps.length - 1);
    const same = found.verdict === answer.verdict && Math.abs(found.time - answer.time) <= ROUNDING && String(seen) === String(answer.steps);
    if (!same) wrong.push(`${row}, ${answer.part} onto ${answer.target}: ${found.verdict} at ${found.time}, elsewhere ${answer.verdict} at ${answer.time}`);
    for (const object of [part, target, found]) object.free();
  }
  const kinds = new Set(answers.map(({ verdict }) => verdict));
  if (wrong.length > 0) console.error(`${wrong.length} of ${answers.length} answers differ: ${wrong.slice(0, 5).join("; ")}`);
  else if (!kinds.has("contact") || !kinds.has("free")) console.error("answers of one kind check nothing");
  else page.equal = "drawn";

  // A throw towards the target, by pointer.
  const pause = () => new Promise((done) => setTimeout(done, 16));
  const send = (type, spot, target) => target.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, button: 0, ...spot }));
  const side = Workshop.side(0);
  document.getElementById("scene").dispatchEvent(new Event("change"));
  document.getElementById("time").value = 0;
  document.getElementById("time").dispatchEvent(new Event("input"));
  const from = side.spot(Workshop.state.place);
  const goal = side.spot([0, 0, 0]);
  send("pointerdown", from, side.stage.renderer.domElement);
  const at = (k) => ({ clientX: from.clientX + (k * (goal.clientX - from.clientX)) / 12, clientY: from.clientY + (k * (goal.clientY - from.clientY)) / 12 });
  for (let k = 1; k <= 8; k += 1) {
    await pause();
    send("pointermove", at(k), window);
  }
  send("pointerup", at(8), window);
  const { velocity, found } = Workshop.state;
  if (velocity[0] < -0.4 && velocity[0] !== -9.4 && found.verdict === "contact") page.thrown = "drawn";
  else console.error(`thrown with ${velocity}: ${found.verdict}`);
})().catch((error) => console.error(error.stack));
