// Shows both bodies of a scene, moved by the formula of their motions.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("views").textContent);
  const element = (id) => document.getElementById(`view-${id}`);
  const [plot, scenes, shots, slider, now] = ["plot", "scene", "shot", "time", "now"].map(element);
  const page = document.documentElement.dataset;
  const PLAY_SECONDS = 4;
  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)).buffer;
  const decoded = new Map();
  let state = null;

  // The positions and faces of a mesh, decoded when it is first shown.
  function mesh(index) {
    if (!decoded.has(index)) {
      const { vertices, faces } = data.meshes[index];
      const places = new Float32Array(bytes(vertices));
      const corners = new Uint32Array(bytes(faces));
      const column = (array, k) => array.filter((_, index) => index % 3 === k);
      decoded.set(index, { places, i: column(corners, 0), j: column(corners, 1), k: column(corners, 2) });
    }
    return decoded.get(index);
  }

  const times = (m, v) => [0, 3, 6].map((r) => m[r] * v[0] + m[r + 1] * v[1] + m[r + 2] * v[2]);

  // The rotation by a rotation vector, as a matrix by rows (Rodrigues).
  function turn(vector) {
    const angle = Math.hypot(...vector);
    if (!(angle > 0)) return [1, 0, 0, 0, 1, 0, 0, 0, 1];
    const [x, y, z] = vector.map((component) => component / angle);
    const [s, c] = [Math.sin(angle), Math.cos(angle)];
    const d = 1 - c;
    return [
      c + d * x * x, d * x * y - s * z, d * x * z + s * y,
      d * x * y + s * z, c + d * y * y, d * y * z - s * x,
      d * x * z - s * y, d * y * z + s * x, c + d * z * z,
    ];
  }

  // x(t) = exp(t[ω]) R₀ (x − c) + C₀ + v t.
  function pose(motion, t) {
    const by = turn(motion.spin.map((w) => w * t));
    const columns = [0, 1, 2].map((k) => times(by, [0, 3, 6].map((r) => motion.rotation[r + k])));
    const rotation = [0, 1, 2].flatMap((row) => columns.map((column) => column[row]));
    const back = times(rotation, motion.centre);
    return { rotation, shift: motion.from.map((p, k) => p + motion.velocity[k] * t - back[k]) };
  }

  function placed(places, { rotation: m, shift }) {
    const count = places.length / 3;
    const [x, y, z] = [new Float32Array(count), new Float32Array(count), new Float32Array(count)];
    for (let n = 0; n < count; n += 1) {
      const [a, b, c] = [places[3 * n], places[3 * n + 1], places[3 * n + 2]];
      x[n] = m[0] * a + m[1] * b + m[2] * c + shift[0];
      y[n] = m[3] * a + m[4] * b + m[5] * c + shift[1];
      z[n] = m[6] * a + m[7] * b + m[8] * c + shift[2];
    }
    return { x, y, z };
  }

  function body(name, index, motion, t, color, opacity) {
    const { places, i, j, k } = mesh(index);
    return {
      type: "mesh3d", name, showlegend: true, color, opacity, flatshading: true, hoverinfo: "name",
      lighting: { ambient: 0.65, diffuse: 0.5, specular: 0.05, roughness: 0.9, facenormalsepsilon: 0, vertexnormalsepsilon: 0 },
      lightposition: { x: 2000, y: 1000, z: 4000 },
      ...placed(places, pose(motion, t)), i, j, k,
    };
  }

  // The nearest points, and the normal as an arrow from A to B.
  function marks(contact, length) {
    if (contact === null) return [];
    const { witness_a: from, witness_b: to, normal } = contact;
    const tip = from.map((p, k) => p + length * normal[k]);
    const [x, y, z] = [0, 1, 2].map((k) => [from[k], tip[k]]);
    return [
      { type: "scatter3d", name: "nearest points", mode: "markers", x: [from[0], to[0]], y: [from[1], to[1]], z: [from[2], to[2]],
        marker: { size: 5, color: "#000" }, hoverinfo: "name+x+y+z" },
      { type: "scatter3d", name: "normal", mode: "lines", x, y, z, line: { color: "#000", width: 6 }, hoverinfo: "name" },
      { type: "cone", x: [tip[0]], y: [tip[1]], z: [tip[2]], u: [normal[0]], v: [normal[1]], w: [normal[2]], anchor: "tail",
        sizemode: "raw", sizeref: 0.3 * length, showscale: false, colorscale: [[0, "#000"], [1, "#000"]], hoverinfo: "skip" },
    ];
  }

  // The axes contain everything from start to end.
  function extent(traces) {
    const low = [Infinity, Infinity, Infinity];
    const high = [-Infinity, -Infinity, -Infinity];
    for (const trace of traces) {
      ["x", "y", "z"].forEach((axis, k) => {
        for (const value of trace[axis]) {
          if (value < low[k]) low[k] = value;
          if (value > high[k]) high[k] = value;
        }
      });
    }
    return { low, high, sides: low.map((value, k) => Math.max(high[k] - value, 1e-9)) };
  }

  function layout({ low, high, sides }) {
    const longest = Math.max(...sides);
    const axis = (k) => ({ range: [low[k] - 0.02 * longest, high[k] + 0.02 * longest], title: { text: "xyz"[k] }, showbackground: false, gridcolor: "#e4e4e4" });
    const [x, y, z] = sides.map((side) => (1.3 * (side + 0.04 * longest)) / longest);
    return {
      margin: { l: 0, r: 0, t: 0, b: 0 }, legend: { x: 0, y: 1 }, uirevision: plot.dataset.shown,
      scene: { xaxis: axis(0), yaxis: axis(1), zaxis: axis(2), aspectmode: "manual", aspectratio: { x, y, z },
        camera: { eye: { x: 1.0, y: 1.2, z: 0.8 } } },
    };
  }

  function draw() {
    stop();
    const view = data.views[scenes.selectedIndex];
    const shot = view.shots[shots.selectedIndex];
    const t = shot.time ?? shot.duration;
    const ends = [body("A, start", view.a, shot.a, 0, "#d55e00", 0.2), body("A, end", view.a, shot.a, shot.duration, "#0072b2", 0.2)];
    const moving = [body("B", view.b, shot.b, t, "#e6c229", 1), body("A", view.a, shot.a, t, "#3a9d6e", 1)];
    const box = extent([...moving, ...ends]);
    const traces = [...moving, ...ends, ...marks(shot.contact, 0.12 * Math.max(...box.sides))];
    state = { view, shot, t };
    plot.dataset.shown = `${scenes.selectedIndex}-${shots.selectedIndex}`;
    element("status").textContent = shot.status;
    element("contact").disabled = shot.time === null;
    showTime();
    return Plotly.react(plot, traces, layout(box), { responsive: true, displaylogo: false });
  }

  function showTime() {
    slider.value = Math.round((1000 * state.t) / state.shot.duration);
    now.textContent = state.t.toPrecision(5);
  }

  // The next pose is drawn after the last one is complete, so a large mesh drops frames instead of queueing them.
  let drawing = false;
  async function move(t) {
    state.t = t;
    showTime();
    if (drawing) return;
    drawing = true;
    let drawn = null;
    while (drawn !== state.t) {
      drawn = state.t;
      const { view, shot } = state;
      const b = placed(mesh(view.b).places, pose(shot.b, drawn));
      const a = placed(mesh(view.a).places, pose(shot.a, drawn));
      await Plotly.restyle(plot, { x: [b.x, a.x], y: [b.y, a.y], z: [b.z, a.z] }, [0, 1]);
    }
    drawing = false;
  }

  let frame = null;
  function stop() {
    if (frame !== null) cancelAnimationFrame(frame);
    frame = null;
    element("play").textContent = "Play";
  }

  function play() {
    if (frame !== null) { stop(); return; }
    const { duration } = state.shot;
    const from = state.t < duration ? state.t : 0;
    let start = null;
    const step = (clock) => {
      start ??= clock;
      const t = Math.min(from + ((clock - start) / 1000 / PLAY_SECONDS) * duration, duration);
      move(t);
      if (t < duration) frame = requestAnimationFrame(step);
      else stop();
    };
    element("play").textContent = "Pause";
    frame = requestAnimationFrame(step);
  }

  function choose() {
    shots.replaceChildren(...data.views[scenes.selectedIndex].shots.map((shot) => new Option(shot.name)));
    return draw();
  }

  function hasWebGl() {
    const context = document.createElement("canvas").getContext("webgl");
    context?.getExtension("WEBGL_lose_context")?.loseContext();
    return context !== null;
  }

  scenes.addEventListener("change", choose);
  shots.addEventListener("change", draw);
  slider.addEventListener("input", () => { stop(); move((slider.value / 1000) * state.shot.duration); });
  element("play").addEventListener("click", play);
  element("contact").addEventListener("click", () => { stop(); move(state.shot.time); });
  for (const view of data.views) scenes.add(new Option(view.scene));
  if (data.views.length === 0) {
    page.view = "empty";
  } else if (!hasWebGl()) {
    page.view = "no-webgl";
    element("status").textContent = "This browser has no WebGL: no view in three dimensions.";
  } else {
    choose().then(() => { page.view = "drawn"; });
  }
})();
