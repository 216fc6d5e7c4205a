// The page. A part is thrown at a static target at the origin. One side shows the certified contact, and the other
// one fixed steps.

import { init, Motion } from "rigid-ccd";
import { Vector3 } from "three";
import { certifiedText, certify, DURATION, firstStepInContact, steppingText } from "./questions.js";
import { makeThrowable } from "./pointer.js";
import { partOfFile, SCENES } from "./scenes.js";
import { Stage } from "./stage.js";

// The factor by which a throw is slowed down on the page.
const SLOWER = 4;
// The time after its contact at which a scene is first shown, in seconds.
const SHOWN_AFTER = 0.06;
const SPIN_AXIS = new Vector3(0.36, 0.48, 0.8);

const element = (id) => document.getElementById(id);
const number = (id) => Number(element(id).value);
const rate = () => Math.round(10 ** number("rate"));
// The last step at or before a time.
const stepBefore = (time) => Math.floor(time * rate() + 1e-9);

const parts = { thrown: null, target: null };
let [certified, stepping] = [null, null];
// The throw, and the time of it that is shown.
let [position, velocity, motion, now] = [null, null, null, 0];
// The times at which the part stops on each side, and the next animation frame.
let [certifiedEnd, steppingEnd, frame] = [DURATION, DURATION, null];

/** Asks both sides about the present throw, and shows it at a time. */
function ask(time) {
  const spin = SPIN_AXIS.clone().multiplyScalar(2 * Math.PI * number("spin"));
  motion?.free();
  motion = new Motion({ position, velocity, angularVelocity: spin });
  const contact = certify(parts, motion);
  const seen = firstStepInContact(parts, motion, rate());
  [certifiedEnd, steppingEnd] = [contact.time ?? contact.safeUntil, seen ?? DURATION];
  say("certified", certifiedText(contact), "good");
  const { text, wrong } = steppingText(contact, seen, rate(), velocity.length());
  say("stepping", text, wrong ? "bad" : "");
  const way = Array.from({ length: 6 }, (_, k) => motion.pose((k / 6) * certifiedEnd));
  certified.draw(parts, { ghosts: way, contact });
  const { reach } = parts.thrown;
  const spacing = Math.ceil((0.6 * reach * rate()) / velocity.length());
  const steps = Array.from({ length: stepBefore(steppingEnd) + 1 }, (_, k) => motion.pose(k / rate()));
  const near = (pose) => Math.hypot(...pose.position) < 2 * (position.length() + reach);
  stepping.draw(parts, { ghosts: steps.filter((pose, k) => k % spacing === 0 && near(pose)), wrong });
  const values = { rate: rate(), speed: `${velocity.length().toPrecision(3)} m/s`, spin: number("spin") };
  for (const [id, value] of Object.entries(values)) element(`${id}-value`).textContent = value;
  pause();
  show(time);
}

function show(time) {
  now = time;
  element("time").value = time;
  element("time-value").textContent = `${time.toFixed(3)} s`;
  certified.place(motion.pose(Math.min(time, certifiedEnd)));
  stepping.place(motion.pose(stepBefore(Math.min(time, steppingEnd)) / rate()));
}

function play() {
  const from = now < DURATION ? now : 0;
  let began = null;
  const next = (clock) => {
    began ??= clock;
    show(Math.min(from + (clock - began) / 1000 / SLOWER, DURATION));
    if (now < DURATION) frame = requestAnimationFrame(next);
    else pause();
  };
  frame = requestAnimationFrame(next);
  element("play").textContent = "Pause";
}

function pause() {
  cancelAnimationFrame(frame);
  frame = null;
  element("play").textContent = "Play";
}

const pointer = {
  grab: pause,
  hold(held) {
    position = held;
    for (const stage of [certified, stepping]) stage.place({ position: held.toArray(), rotation: [0, 0, 0, 1] });
  },
  release(thrown) {
    if (thrown) setVelocity(thrown);
    ask(0);
    if (thrown) play();
  },
  move(step) {
    position = position.clone().add(step);
    ask(now);
  },
};

function setVelocity(given) {
  velocity = given;
  element("speed").value = Math.log10(given.length());
}

function openScene() {
  const scene = SCENES[Number(location.hash.slice(1))] ?? SCENES[0];
  element("scene").selectedIndex = SCENES.indexOf(scene);
  element("file").value = "";
  begin({ thrown: scene.part(), target: scene.target() }, scene);
}

async function openFile() {
  const [file] = element("file").files;
  if (!file) return;
  try {
    begin({ thrown: partOfFile(file.name, await file.arrayBuffer()) }, SCENES[element("scene").selectedIndex]);
  } catch (error) {
    say("certified", error.message, "bad");
    say("stepping", "The part is still the one before.", "");
  }
}

/** Replaces the parts, frees the old ones, and throws the new part as the scene tells. */
function begin(others, scene) {
  for (const [role, part] of Object.entries(others)) {
    parts[role]?.body.free();
    parts[role]?.geometry.dispose();
    parts[role] = part;
  }
  position = new Vector3(...scene.position);
  element("spin").value = scene.turns;
  setVelocity(new Vector3(...scene.velocity));
  ask(0);
  show(Math.min(certifiedEnd + SHOWN_AFTER, DURATION));
}

function say(side, text, tone) {
  Object.assign(element(`${side}-text`), { textContent: text, className: tone });
}

function listen(id, event, handler) {
  element(id).addEventListener(event, handler);
}

async function main() {
  await init();
  const turned = () => [certified, stepping].forEach((stage) => stage.render());
  [certified, stepping] = ["certified", "stepping"].map((id) => new Stage(element(id), turned));
  element("scene").append(...SCENES.map(({ name }) => new Option(name)));
  element("rate").value = Math.log10(60);
  openScene();
  listen("scene", "change", () => { location.hash = element("scene").selectedIndex; });
  listen("file", "change", openFile);
  listen("play", "click", () => (frame === null ? play() : pause()));
  listen("time", "input", () => { pause(); show(number("time")); });
  for (const id of ["rate", "spin"]) listen(id, "input", () => ask(now));
  listen("speed", "input", () => { velocity.setLength(10 ** number("speed")); ask(now); });
  window.addEventListener("hashchange", openScene);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => ask(now));
  for (const stage of [certified, stepping]) makeThrowable(stage, pointer);
}

main().catch((error) => say("certified", error.message, "bad"));
