// Shows views: bodies in motion, ghosts of their steps, the gap, the contacts.
"use strict";
(() => {
  const data = JSON.parse(document.getElementById("views").textContent);
  const page = document.documentElement.dataset;
  const element = (id) => document.getElementById(`view-${id}`);
  const [groups, views, list, words] = ["scene", "shot", "contacts", "status"].map(element);
  const GHOST = 0.13;
  // The greatest number of contacts in the list; the plot shows all.
  const LISTED = 1000;
  let [stage, player, plot, shown] = [null, null, null, null];

  const bytes = (text) => Uint8Array.from(atob(text), (character) => character.charCodeAt(0)).buffer;
  const geometries = new Map();

  // Returns the geometry of a mesh, relative to the center of its box; it is decoded when it is first shown.
  function geometry(index) {
    if (!geometries.has(index)) {
      const { vertices, faces } = data.meshes[index];
      const made = new THREE.BufferGeometry();
      made.setAttribute("position", new THREE.BufferAttribute(new Float32Array(bytes(vertices)), 3));
      made.setIndex(new THREE.BufferAttribute(new Uint32Array(bytes(faces)), 1));
      made.computeBoundingBox();
      geometries.set(index, made);
    }
    return geometries.get(index);
  }

  const ghostly = new Map();

  // Returns the geometry for ghosts. There are many ghosts, so that a fine mesh is simplified.
  function ghost(index) {
    if (!ghostly.has(index)) ghostly.set(index, Coarse.of(geometry(index)));
    return ghostly.get(index);
  }

  // Returns the pose of the center of a body's mesh at a time, relative to the view's origin.
  function placed(view, body, t) {
    const { rotation, place } = Motion.pose(body.motion, t);
    const middle = Motion.apply(rotation, data.meshes[body.mesh].middle);
    return { rotation, place: place.map((p, k) => p + middle[k] - view.origin[k]) };
  }

  // Returns the corners of the boxes about all bodies, at some times from the start to `until`.
  function corners(view, until) {
    const times = Array.from({ length: 9 }, (_, k) => (k * until) / 8);
    return view.bodies.flatMap((body) => {
      const { min, max } = geometry(body.mesh).boundingBox;
      const box = [0, 1, 2, 3, 4, 5, 6, 7].map((k) => [k & 1 ? min.x : max.x, k & 2 ? min.y : max.y, k & 4 ? min.z : max.z]);
      return (Motion.moves(body.motion) ? times : [0]).flatMap((t) => {
        const { rotation, place } = placed(view, body, t);
        return box.map((corner) => Motion.apply(rotation, corner).map((c, k) => c + place[k]));
      });
    });
  }

  function ghosts(view) {
    for (const t of element("ghosts").checked ? view.ghost_times : []) {
      for (const body of view.bodies.filter(({ motion }) => Motion.moves(motion))) {
        stage.place(stage.addMesh(ghost(body.mesh), body.color, GHOST), placed(view, body, t));
      }
    }
  }

  function draw() {
    const { view, contact } = shown;
    stage.clear();
    shown.meshes = view.bodies.map((body) => stage.addMesh(geometry(body.mesh), body.color));
    ghosts(view);
    if (contact) Marks.draw(stage, contact, shown.size);
    show(player.t);
  }

  function show(t) {
    if (!shown.meshes) return;
    shown.view.bodies.forEach((body, k) => stage.place(shown.meshes[k], placed(shown.view, body, t)));
    plot.move(t);
    stage.render();
  }

  // Returns a contact in coordinates relative to the view's origin.
  function moved(view, contact) {
    const shift = (point) => point.map((p, k) => p - view.origin[k]);
    return { ...contact, witnesses: contact.witnesses?.map(shift) ?? null, highlight_a: contact.highlight_a.map(shift), highlight_b: contact.highlight_b.map(shift) };
  }

  function choose(number) {
    const { view } = shown;
    const contact = view.contacts[number];
    shown.contact = moved(view, contact);
    for (const [k, item] of [...list.children].entries()) item.firstChild.setAttribute("aria-pressed", String(k === number));
    player.jump(contact.time);
    draw();
  }

  function legend(view) {
    // The bodies of one link have the same name and colour.
    const isFirst = ({ name, color }, k) => view.bodies.findIndex((body) => body.name === name && body.color === color) === k;
    const parts = view.bodies.filter(isFirst);
    const named = parts.length <= 12 ? parts : [];
    element("legend").replaceChildren(...named.map(({ name, color }) => {
      const item = document.createElement("li");
      const patch = document.createElement("span");
      patch.style.background = color;
      item.append(patch, name);
      return item;
    }));
  }

  function open() {
    const view = data.groups[groups.selectedIndex].views[views.selectedIndex];
    const until = view.contacts.length === 1 ? view.contacts[0].time : view.duration;
    const points = corners(view, until);
    const size = new THREE.Box3().setFromPoints(points.map((p) => new THREE.Vector3(...p))).getSize(new THREE.Vector3());
    shown = { view, contact: null, meshes: null, size: size.length() };
    words.textContent = view.verdict;
    legend(view);
    element("steps").hidden = view.ghost_times.length === 0;
    element("gap-words").hidden = view.gap === null;
    element("required-words").hidden = (view.gap?.required ?? null) === null;
    element("steps-words").hidden = view.ghost_times.length === 0;
    list.hidden = view.contacts.length < 2;
    list.replaceChildren(...view.contacts.slice(0, LISTED).map(({ words: text }, number) => {
      const item = document.createElement("li");
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = text;
      button.addEventListener("click", () => choose(number));
      item.append(button);
      return item;
    }));
    plot.open(view);
    player.open(view, view.time);
    if (view.contacts.length > 0) choose(0);
    else draw();
    stage.fit(points);
  }

  function openGroup() {
    views.replaceChildren(...data.groups[groups.selectedIndex].views.map(({ name }) => new Option(name)));
    open();
  }

  function keys(event) {
    const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.target.closest("input, select, button")) return;
    if (event.key === " ") player.toggle();
    else if (by) player.jump(Math.min(Math.max(player.t + (by * player.duration) / 100, 0), player.duration));
    else return;
    event.preventDefault();
  }

  groups.replaceChildren(...data.groups.map(({ name }) => new Option(name)));
  element("scene-label").hidden = data.groups.length < 2;
  element("shot-label").hidden = data.groups.every((group) => group.views.length < 2);
  if (data.groups.length === 0) {
    page.view = "empty";
  } else if (!Stage.hasWebGl()) {
    page.view = "no-webgl";
    words.textContent = "This browser has no WebGL: no view in three dimensions.";
  } else {
    stage = new Stage(element("stage"), data.meshes.reduce((sum, { faces }) => sum + faces.length / 16, 0));
    plot = new GapPlot(element("gap"), (t) => player.jump(t));
    player = new Player(element, show);
    groups.addEventListener("change", openGroup);
    views.addEventListener("change", open);
    element("ghosts").addEventListener("change", draw);
    element("fit").addEventListener("click", () => stage.fit(corners(shown.view, shown.view.duration)));
    element("stage").addEventListener("keydown", keys);
    openGroup();
    stage.renderNow();
    page.view = "drawn";
  }
})();
