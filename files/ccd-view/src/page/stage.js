// A stage in three dimensions: meshes with poses, lines and points. It knows nothing of queries.
"use strict";

class Stage {
  static hasWebGl() {
    const context = document.createElement("canvas").getContext("webgl2");
    context?.getExtension("WEBGL_lose_context")?.loseContext();
    return context !== null;
  }

  // `triangles` is the approximate number of triangles. Many are drawn without antialiasing, which is slow without a graphics card.
  constructor(holder, triangles) {
    this.holder = holder;
    this.renderer = new THREE.WebGLRenderer({ antialias: triangles < 60000 });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    this.renderer.setClearColor("#ffffff");
    holder.append(this.renderer.domElement);
    this.camera = new THREE.PerspectiveCamera(35, 1, 0.1, 10);
    this.camera.up.set(0, 0, 1);
    this.scene = new THREE.Scene();
    this.scene.add(new THREE.HemisphereLight("#ffffff", "#8890a0", 2.2));
    this.sun = new THREE.DirectionalLight("#ffffff", 1.6);
    this.scene.add(this.sun);
    this.content = new THREE.Group();
    this.scene.add(this.content);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.render());
    // The points that `fit` has shown are fitted again when the page is resized, until the user turns the view.
    this.fitted = null;
    this.controls.addEventListener("start", () => { this.fitted = null; });
    this.asked = null;
    new ResizeObserver(() => this.resize()).observe(holder);
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.holder;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (this.fitted !== null) this.fit(this.fitted);
    this.render();
  }

  // Draws before the next frame, once.
  render() {
    this.asked ??= requestAnimationFrame(() => this.renderNow());
  }

  renderNow() {
    if (this.asked !== null) cancelAnimationFrame(this.asked);
    this.asked = null;
    this.sun.position.copy(this.camera.position).add(new THREE.Vector3(0.3, 0.2, 0.8).multiplyScalar(this.camera.position.length()));
    this.renderer.render(this.scene, this.camera);
  }

  clear() {
    this.content.traverse((object) => {
      object.material?.dispose();
      if (object.userData.own) object.geometry.dispose();
    });
    this.content.clear();
  }

  // Moves the camera so that all points are in view, from above and across their longer side.
  fit(points) {
    this.fitted = points;
    const box = new THREE.Box3().setFromPoints(points.map((p) => new THREE.Vector3(...p)));
    const middle = box.getCenter(new THREE.Vector3());
    const depth = (side) => points.reduce((most, p) => Math.max(most, Math.abs(new THREE.Vector3(...p).sub(middle).dot(side))), 0);
    const sides = [[0.55, -0.75, 0.4], [0.75, 0.55, 0.4]].map((side) => new THREE.Vector3(...side).normalize());
    const back = depth(sides[0]) <= depth(sides[1]) ? sides[0] : sides[1];
    const right = new THREE.Vector3(0, 0, 1).cross(back).normalize();
    const up = back.clone().cross(right);
    const tall = Math.tan((this.camera.fov * Math.PI) / 360);
    const away = points.reduce((most, p) => {
      const seen = new THREE.Vector3(...p).sub(middle);
      const across = Math.max(Math.abs(seen.dot(right)) / (tall * this.camera.aspect), Math.abs(seen.dot(up)) / tall);
      return Math.max(most, 1.08 * across + seen.dot(back));
    }, 1e-30);
    this.camera.position.copy(middle).addScaledVector(back, away);
    [this.camera.near, this.camera.far] = [away / 500, away * 20];
    this.camera.updateProjectionMatrix();
    this.controls.target.copy(middle);
    this.controls.update();
    this.render();
  }

  // Adds a mesh; an opaque mesh hides the objects behind it.
  addMesh(geometry, color, opacity = 1) {
    const solid = opacity === 1;
    const material = new THREE.MeshLambertMaterial({ color, flatShading: true, side: THREE.DoubleSide, transparent: !solid, opacity, depthWrite: solid });
    const mesh = new THREE.Mesh(geometry, material);
    mesh.matrixAutoUpdate = false;
    this.content.add(mesh);
    return mesh;
  }

  // Sets the pose of a mesh: its rotation matrix by rows, and the position of its origin.
  place(mesh, { rotation: m, place: p }) {
    mesh.matrix.set(m[0], m[1], m[2], p[0], m[3], m[4], m[5], p[1], m[6], m[7], m[8], p[2], 0, 0, 0, 1);
    mesh.matrixWorldNeedsUpdate = true;
  }

  // Adds a bar from one point to another, in front of everything.
  addBar([from, to], radius, color) {
    const [start, end] = [from, to].map((p) => new THREE.Vector3(...p));
    const way = end.clone().sub(start);
    const bar = new THREE.Mesh(new THREE.CylinderGeometry(radius, radius, way.length(), 8), new THREE.MeshBasicMaterial({ color, depthTest: false }));
    bar.position.copy(start).addScaledVector(way, 0.5);
    bar.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), way.normalize());
    bar.renderOrder = 2;
    this.own(bar);
  }

  // Adds filled triangles, three points each; they are visible through objects in front of them, but fainter.
  addTriangles(points, color) {
    const geometry = new THREE.BufferGeometry().setFromPoints(points.map((p) => new THREE.Vector3(...p)));
    const common = { color, side: THREE.DoubleSide, transparent: true, depthWrite: false };
    const seen = { ...common, opacity: 0.6, polygonOffset: true, polygonOffsetFactor: -2, polygonOffsetUnits: -2 };
    const hidden = { ...common, opacity: 0.15, depthTest: false };
    for (const look of [seen, hidden]) {
      const mesh = new THREE.Mesh(geometry, new THREE.MeshBasicMaterial(look));
      mesh.renderOrder = 1;
      this.own(mesh);
    }
  }

  addBall(center, radius, color) {
    const ball = new THREE.Mesh(new THREE.SphereGeometry(radius, 16, 12), new THREE.MeshBasicMaterial({ color, depthTest: false }));
    ball.position.set(...center);
    ball.renderOrder = 3;
    this.own(ball);
  }

  addArrow(from, direction, length, color) {
    const arrow = new THREE.ArrowHelper(new THREE.Vector3(...direction), new THREE.Vector3(...from), length, color, 0.2 * length, 0.09 * length);
    for (const part of [arrow.line, arrow.cone]) {
      part.material.depthTest = false;
      part.renderOrder = 3;
    }
    // ArrowHelper shares its geometries among all arrows.
    this.content.add(arrow);
  }

  // Adds an object whose geometry is disposed of with it.
  own(object) {
    object.userData.own = true;
    this.content.add(object);
  }
}
