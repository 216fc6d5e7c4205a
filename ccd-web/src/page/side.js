// One side of the page: a stage with the target, the part that is thrown, and what is known of it.
"use strict";

class Side {
  constructor(holder) {
    this.stage = new Stage(holder, 0);
    this.pointer = new THREE.Raycaster();
  }

  // Draws everything but the part's place. `ghosts` are poses with a colour, `marks` points and a normal.
  draw({ part, target, color, ghosts, marks, size }) {
    const { stage } = this;
    stage.clear();
    stage.addMesh(target, "#e6c229");
    for (const { pose, color: ghostly } of ghosts) stage.place(stage.addMesh(part, ghostly, 0.22), pose);
    this.part = stage.addMesh(part, color);
    if (marks.length === 0) return;
    const [a, b, normal] = [0, 3, 6].map((k) => Array.from(marks.slice(k, k + 3)));
    for (const point of [a, b]) stage.addBall(point, 0.008 * size, "#111");
    if (normal.length === 3) stage.addArrow(a, normal, 0.18 * size, "#111");
  }

  place(pose) {
    this.shown = pose.place;
    this.stage.place(this.part, pose);
    this.stage.render();
  }

  // The ray from the eye through a place on the screen.
  ray({ clientX, clientY }) {
    const { left, top, width, height } = this.stage.holder.getBoundingClientRect();
    const spot = new THREE.Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
    this.stage.camera.updateMatrixWorld();
    this.pointer.setFromCamera(spot, this.stage.camera);
    return this.pointer.ray;
  }

  // Where the part is on the screen.
  spot(place) {
    const { left, top, width, height } = this.stage.holder.getBoundingClientRect();
    this.stage.camera.updateMatrixWorld();
    const seen = new THREE.Vector3(...place).project(this.stage.camera);
    return { clientX: left + ((seen.x + 1) / 2) * width, clientY: top + ((1 - seen.y) / 2) * height };
  }

  look(camera, target) {
    this.stage.camera.position.copy(camera.position);
    this.stage.controls.target.copy(target);
    this.stage.controls.update();
    this.stage.render();
  }
}
