// The page: scenes, throws by pointer, both sides.
"use strict";

const Workshop = (() => {
  const element = (id) => document.getElementById(id);
  const page = document.documentElement.dataset;
  const { DURATION } = Parts;
  const GREEN = "#3a9d6e";
  const RED = "#d55e00";
  // Ghosts of more steps than this hide what they show.
  const GHOSTS = 60;
  // The ghosts of the part on its way to the contact.
  const WAY = 6;
  // A step that is later than a contact by less than this, in seconds, is at the same time.
  const ROUNDING = 1e-9;
  // A pointer that misses a part by this many pixels still takes it.
  const NEAR = 22;
  // The size of a visitor's own part, in metres.
  const SIZE = 0.5;
  // A scene is first seen this long after the contact, in seconds.
  const SHOWN_AFTER = 0.04;
  const AXIS = [0.36, 0.48, 0.8];

  const SCENES = [
    { name: "A bullet and a sheet of 2 mm", part: "bullet", target: "sheet", place: [1.02, 0.05, 0.05], velocity: [-9.4, 0, 0], turns: 1 },
    { name: "A coin and a post", part: "coin", target: "post", place: [1.1, 0.02, 0.1], velocity: [-7, 0, 0], turns: 3 },
    { name: "A spinning rod and a slot", part: "rod", target: "slot", place: [1, 0, 0], velocity: [-3, 0, 0], turns: 0.7 },
    { name: "A ball and a sheet", part: "ball", target: "sheet", place: [1.1, 0, 0], velocity: [-30, 0, 0], turns: 0 },
    { name: "Two knots", part: "knot", target: "knot", place: [1.1, 0.1, 0.1], velocity: [-2.5, 0, 0], turns: 2 },
  ];

  let [sides, player] = [null, null];
  const state = { part: null, target: null, place: null, velocity: null, found: null, seen: null };

  function drawn(part) {
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(part.vertices, 3));
    geometry.setIndex(new THREE.BufferAttribute(part.faces, 1));
    geometry.computeBoundingSphere();
    return { part, geometry };
  }

  const rate = () => Math.round(10 ** Number(element("rate").value));
  const spin = () => AXIS.map((a) => a * Number(element("spin").value) * 2 * Math.PI);
  const still = (place) => ({ rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], place });
  const pose = (t) => Motion.pose({ centre: [0, 0, 0], from: state.place, velocity: state.velocity, spin: spin(), rotation: still().rotation }, t);
  const span = () => 2 * (Math.hypot(...state.place) + state.part.part.reach);

  function say(id, text, tone) {
    element(id).textContent = text;
    element(id).className = tone;
  }

  // Asks both sides about the throw.
  function ask() {
    const motion = { position: state.place, velocity: state.velocity, spin: spin() };
    const [part, target] = [state.part.part, state.target.part];
    const { found, micros } = timed(() => Parts.firstContact(part, target, motion));
    state.found = found;
    const touches = Parts.steps(part, target, motion, rate());
    const first = touches.indexOf(1);
    state.seen = { first, time: first < 0 ? DURATION : (first * DURATION) / rate() };
    proven(micros);
    seen();
  }

  // Asks a few times: a browser's clock is coarse.
  function timed(ask) {
    const found = ask();
    let count = 1;
    const began = performance.now();
    for (; count < 100 && performance.now() - began < 20; count += 1) ask();
    const micros = (1000 * (performance.now() - began)) / Math.max(count - 1, 1);
    return { found, micros };
  }

  function proven(micros) {
    const { verdict, time } = state.found;
    const took = micros > 0 ? ` Answered in ${micros < 100 ? `${micros.toPrecision(2)} µs` : micros < 1000 ? `${Math.round(micros)} µs` : `${(micros / 1000).toPrecision(2)} ms`}.` : "";
    const words = {
      contact: `Contact at ${time.toFixed(6)} s. Nothing touches before: proven.`,
      free: "Nothing touches in the whole second: proven.",
      touching: "They touch at the start.",
      overlapping: "They overlap at the start.",
      unresolved: `Not decided; nothing touches before ${time.toFixed(6)} s: proven.`,
    };
    say("proven", words[verdict] + took, "good");
  }

  function seen() {
    const [{ verdict, time }, { first, time: at }] = [state.found, state.seen];
    const late = at - time;
    if (verdict === "contact" && first < 0) say("seen", `None of ${rate()} steps sees the contact: the part passes through.`, "bad");
    else if (verdict === "contact" && late < ROUNDING) say("seen", "A step falls on the contact, and sees it.", "");
    else if (verdict === "contact") {
      const far = late * Math.hypot(...state.velocity);
      say("seen", `Sees it at ${at.toFixed(6)} s: ${(1000 * late).toPrecision(3)} ms late, ${(100 * far).toPrecision(3)} cm farther on.`, late > 1e-3 ? "bad" : "");
    } else if (first > 0) say("seen", `Sees a gap of less than a micrometre at ${at.toFixed(6)} s.`, "");
    else if (verdict === "free" || verdict === "unresolved") say("seen", "Sees no contact at its steps, and proves nothing between them.", "");
    else say("seen", "Sees it at the start, too.", "");
  }

  function ghosts() {
    const count = rate();
    const within = Array.from({ length: count + 1 }, (_, k) => k)
      .filter((k) => (k * DURATION) / count <= state.seen.time)
      .map((k) => ({ k, pose: pose((k * DURATION) / count) }))
      .filter(({ pose: { place } }) => Math.hypot(...place) < span());
    const step = (Math.hypot(...state.velocity) * DURATION) / count;
    const every = Math.max(1, Math.ceil(within.length / GHOSTS), Math.min(Math.ceil((0.4 * state.part.part.reach) / step), within.length));
    return within.filter(({ k }, n) => n % every === 0 || k === state.seen.first).map(({ k, pose: at }) => ({ pose: at, color: k === state.seen.first ? RED : GREEN }));
  }

  // Where the part comes from.
  function way() {
    const times = Array.from({ length: WAY }, (_, k) => (k * state.found.time) / WAY);
    return times.map((t) => ({ pose: pose(t), color: GREEN }));
  }

  function draw() {
    const common = { part: state.part.geometry, target: state.target.geometry, size: span() };
    const missed = state.found.verdict === "contact" && state.seen.time > state.found.time + 1e-3;
    sides[0].draw({ ...common, color: GREEN, ghosts: way(), marks: state.found.points });
    sides[1].draw({ ...common, color: missed ? RED : GREEN, ghosts: ghosts(), marks: [] });
    page.certified = "drawn";
    page.stepping = "drawn";
  }

  // Throws the part as it stands; `t` is shown first.
  function thrown(t) {
    ask();
    draw();
    player.open({ duration: DURATION, start: 0 }, t);
  }

  function show(t) {
    const held = Math.min(t, state.seen.time);
    const times = [Math.min(t, state.found.time), Math.floor(held * rate() + 1e-9) / rate()];
    sides.forEach((side, k) => side.place(pose(times[k])));
  }

  // While the part is held.
  function hold() {
    for (const side of sides) side.place(still(state.place));
  }

  function setSpeed(velocity) {
    state.velocity = velocity;
    element("speed").value = Math.log10(Math.hypot(...velocity));
    label();
  }

  function label() {
    element("rate-value").textContent = rate();
    element("speed-value").textContent = Math.hypot(...state.velocity).toPrecision(3);
    element("spin-value").textContent = element("spin").value;
  }

  // The plane in which a part is dragged: it holds the part and the target's middle, and faces the eye.
  function plane(side) {
    const place = new THREE.Vector3(...state.place);
    const back = side.stage.camera.getWorldDirection(new THREE.Vector3()).negate();
    const way = place.clone().normalize();
    const facing = back.clone().addScaledVector(way, -back.dot(way));
    const normal = facing.length() > 0.2 ? facing.normalize() : back;
    return new THREE.Plane().setFromNormalAndCoplanarPoint(normal, place);
  }

  function grab(side, event) {
    if (event.button !== 0 || !event.isPrimary) return;
    const shown = side.shown;
    const spot = side.spot(shown);
    const rim = side.spot(new THREE.Vector3(...shown).addScaledVector(new THREE.Vector3(1, 0, 0).applyQuaternion(side.stage.camera.quaternion), state.part.part.reach).toArray());
    const radius = Math.hypot(rim.clientX - spot.clientX, rim.clientY - spot.clientY);
    if (Math.hypot(event.clientX - spot.clientX, event.clientY - spot.clientY) > Math.max(radius, NEAR)) return;
    event.stopPropagation();
    player.stop();
    state.place = [...shown];
    const within = plane(side);
    const from = side.ray(event).intersectPlane(within, new THREE.Vector3());
    if (from === null) return;
    const offset = new THREE.Vector3(...state.place).sub(from);
    const places = [];
    const follow = (moved) => {
      if (moved.pointerId !== event.pointerId) return;
      const at = side.ray(moved).intersectPlane(within, new THREE.Vector3());
      if (at === null) return;
      state.place = at.add(offset).clampLength(0, 1e3).toArray();
      places.push({ at: moved.timeStamp, place: state.place });
      hold();
    };
    const handlers = { pointermove: follow, pointerup: release, pointercancel: put };
    function end({ pointerId }) {
      if (pointerId !== event.pointerId) return false;
      for (const [name, handler] of Object.entries(handlers)) window.removeEventListener(name, handler);
      return true;
    }
    function put(last) {
      if (end(last)) thrown(0);
    }
    function release(last) {
      if (!end(last)) return;
      follow(last);
      const velocity = Throw.velocity(places);
      if (velocity !== null) setSpeed(velocity);
      thrown(0);
      if (velocity !== null) player.toggle();
    }
    for (const [name, handler] of Object.entries(handlers)) window.addEventListener(name, handler);
    follow(event);
  }

  // Takes other parts in place of the present ones, whose memory ends.
  function replace(parts) {
    for (const [role, part] of Object.entries(parts)) {
      state[role]?.part.body.free();
      state[role]?.geometry.dispose();
      state[role] = part;
    }
  }

  function open() {
    const scene = SCENES[element("scene").selectedIndex];
    const [part, target] = [scene.part, scene.target].map((name) => drawn(Parts.named(name)));
    replace({ part, target });
    element("file").value = "";
    begin(scene);
  }

  function begin({ place, velocity, turns }) {
    state.place = [...place];
    element("spin").value = turns;
    setSpeed([...velocity]);
    const corners = (x, half) => [[x, -half, -half], [x, half, -half], [x, -half, half], [x, half, half]];
    for (const { stage } of sides) stage.fit([...corners(place[0], Math.max(0.2, state.part.part.reach)), ...corners(0, 0.42), ...corners(-0.4, 0.1)]);
    thrown(0);
    player.jump(Math.min(state.found.time + SHOWN_AFTER, DURATION));
  }

  async function openFile() {
    const [file] = element("file").files;
    if (!file) return;
    try {
      replace({ part: drawn(Parts.fromFile(file.name, await file.arrayBuffer(), SIZE)) });
      begin(SCENES[element("scene").selectedIndex]);
    } catch (error) {
      say("proven", `${file.name}: ${error.message}`, "bad");
      say("seen", "The part is still the one before.", "");
    }
  }

  function listen() {
    for (const { name } of SCENES) element("scene").append(new Option(name));
    element("scene").addEventListener("change", open);
    element("file").addEventListener("change", openFile);
    element("again").addEventListener("click", () => { thrown(0); player.toggle(); });
    for (const id of ["rate", "spin"]) element(id).addEventListener("input", () => { label(); thrown(player.t); });
    element("speed").addEventListener("input", () => {
      const factor = 10 ** Number(element("speed").value) / Math.hypot(...state.velocity);
      state.velocity = state.velocity.map((v) => v * factor);
      label();
      thrown(player.t);
    });
    sides.forEach((side, k) => {
      side.stage.holder.addEventListener("pointerdown", (event) => grab(side, event), { capture: true });
      side.stage.controls.addEventListener("change", () => other(side, sides[1 - k]));
    });
  }

  let following = false;

  // Both sides are seen from the same place.
  function other(side, to) {
    if (following) return;
    following = true;
    to.look(side.stage.camera, side.stage.controls.target);
    following = false;
  }

  async function start() {
    await Parts.load();
    if (!Stage.hasWebGl()) {
      say("proven", "This browser draws nothing in three dimensions (WebGL 2).", "bad");
      return;
    }
    sides = ["left", "right"].map((id) => new Side(element(id)));
    player = new Player(element, show);
    element("rate").value = Math.log10(60);
    listen();
    element("scene").selectedIndex = Math.min(Math.max(Math.floor(Number(location.hash.slice(1))) || 0, 0), SCENES.length - 1);
    open();
  }

  return { state, ready: start(), side: (k) => sides[k] };
})();
