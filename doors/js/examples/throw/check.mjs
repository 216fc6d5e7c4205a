// Throws the part of the page by pointer events. `.ci/doors` adds it to a copy of the page; faults go to the console.

import { Vector3 } from "three";
import { camera } from "./stage.js";

const page = document.documentElement.dataset;
const canvas = document.getElementById("certified");
const texts = () => ["certified-text", "speed-value", "play"].map((id) => document.getElementById(id).textContent);
const pause = (milliseconds) => new Promise((done) => setTimeout(done, milliseconds));

function send(type, x) {
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const seen = new Vector3(x, 0.05, 0.05).project(camera);
  const spot = { clientX: left + ((1 + seen.x) / 2) * width, clientY: top + ((1 - seen.y) / 2) * height };
  canvas.dispatchEvent(new PointerEvent(type, { bubbles: true, pointerId: 1, isPrimary: true, button: 0, ...spot }));
}

while (page.stepping !== "drawn") await pause(50);
const [before] = texts();
// Drags the part away from its contact with the sheet, and throws it back after a while.
send("pointerdown", 0.04);
send("pointermove", 0.9);
await pause(200);
for (const x of [0.9, 0.8, 0.7, 0.6, 0.5]) {
  send("pointermove", x);
  await pause(16);
}
send("pointerup", 0.4);
const [after, speed, button] = texts();
const thrown = after.startsWith("Contact at") && after !== before && speed !== "9.40 m/s" && button === "Pause";
if (thrown) page.thrown = "drawn";
else console.error(`before: ${before}; after: ${after}, ${speed}, ${button}`);
