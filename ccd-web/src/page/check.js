// Checks the page in the browser that shows it: its answers, and a throw by pointer.
"use strict";

(async () => {
  await Workshop.ready;
  const page = document.documentElement.dataset;

  // The answers of the machine that wrote the page. Times may differ in their last bits, as docs/building.md says.
  const ROUNDING = 1e-14;
  const wrong = [];
  const answers = JSON.parse(document.getElementById("answers").textContent);
  for (const [row, answer] of answers.entries()) {
    const [part, target] = [Parts.named(answer.part), Parts.named(answer.target)];
    const [position, velocity, spin] = [0, 3, 6].map((k) => answer.throw.slice(k, k + 3));
    const motion = { position, velocity, spin };
    const found = Parts.firstContact(part, target, motion);
    const seen = Parts.steps(part, target, motion, answer.steps.length - 1);
    const same = found.verdict === answer.verdict && Math.abs(found.time - answer.time) <= ROUNDING && String(seen) === String(answer.steps);
    if (!same) wrong.push(`${row}, ${answer.part} onto ${answer.target}: ${found.verdict} at ${found.time}, elsewhere ${answer.verdict} at ${answer.time}`);
    for (const { body } of [part, target]) body.free();
  }
  const kinds = new Set(answers.map(({ verdict }) => verdict));
  if (wrong.length > 0) console.error(`${wrong.length} of ${answers.length} answers differ: ${wrong.slice(0, 5).join("; ")}`);
  else if (!kinds.has("contact") || !kinds.has("free")) console.error("answers of one kind check nothing");
  else page.equal = "drawn";

  // By pointer: the part is taken where it is seen, put aside, then thrown at the target.
  const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));
  const send = (type, spot, to) => to.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, isPrimary: true, button: 0, ...spot }));
  async function move(from, to) {
    for (let k = 1; k <= 8; k += 1) {
      await pause(16);
      const between = (name) => from[name] + (k * (to[name] - from[name])) / 8;
      send("pointermove", { clientX: between("clientX"), clientY: between("clientY") }, window);
    }
  }
  const side = Workshop.side(0);
  document.getElementById("scene").dispatchEvent(new Event("change"));
  const [seen, aside, near] = [side.shown, [0.8, 0, 0], [0.3, 0, 0]].map((place) => side.spot(place));
  send("pointerdown", seen, side.stage.renderer.domElement);
  await move(seen, aside);
  await pause(200);
  send("pointermove", aside, window);
  await move(aside, near);
  send("pointerup", near, window);
  const { place, velocity, found } = Workshop.state;
  if (place[0] > 0.2 && velocity[0] < -0.4 && velocity[0] !== -9.4 && found.verdict === "contact") page.thrown = "drawn";
  else console.error(`thrown from ${place} with ${velocity}: ${found.verdict}`);
  // A throw that is cancelled is put down.
  send("pointerdown", side.spot(place), side.stage.renderer.domElement);
  send("pointercancel", { clientX: 0, clientY: 0 }, window);
  if (String(Workshop.state.velocity) !== String(velocity)) console.error("a cancelled throw is thrown");
})().catch((error) => console.error(error.stack));
