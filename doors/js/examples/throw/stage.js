// One side of the page: the target, the part, its earlier positions, and a contact. Both sides share one camera.

import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";

const [GREEN, RED, YELLOW] = ["#3a9d6e", "#d55e00", "#e6c229"];
// The largest number of ghosts. More of them would hide each other.
const GHOSTS = 20;

export const camera = new THREE.PerspectiveCamera(40, 5 / 4, 0.01, 200);
camera.up.set(0, 0, 1);
camera.position.set(0.9, -1.9, 0.85);
const middle = new THREE.Vector3(0.4, 0, 0);

export class Stage {
  /** Calls `turned` when the view is turned, on either side. */
  constructor(canvas, turned) {
    this.canvas = canvas;
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    const look = (options) => new THREE.MeshLambertMaterial({ side: THREE.DoubleSide, ...options });
    this.target = new THREE.Mesh(undefined, look({ color: YELLOW }));
    this.part = new THREE.Mesh(undefined, look());
    this.ghosts = new THREE.InstancedMesh(undefined, look({ color: GREEN, transparent: true, opacity: 0.2, depthWrite: false }), GHOSTS);
    this.ghosts.frustumCulled = false;
    this.marks = new THREE.Group();
    this.sun = new THREE.DirectionalLight("#fff", 2);
    this.scene = new THREE.Scene().add(this.sun, new THREE.AmbientLight("#fff", 1.6), this.target, this.part, this.ghosts, this.marks);
    this.controls = new OrbitControls(camera, canvas);
    Object.assign(this.controls, { target: middle, enablePan: false });
    this.controls.listenToKeyEvents(canvas);
    this.controls.update();
    this.controls.addEventListener("change", turned);
    new ResizeObserver(() => {
      this.renderer.setSize(canvas.clientWidth, canvas.clientHeight, false);
      this.render();
    }).observe(canvas);
  }

  /** Draws all but the pose of the part. `ghosts` are poses; a contact has witness points, and a normal. */
  draw({ thrown, target }, { ghosts, contact, wrong }) {
    this.part.geometry = this.ghosts.geometry = thrown.geometry;
    this.target.geometry = target.geometry;
    this.part.material.color.set(wrong ? RED : GREEN);
    const every = Math.ceil(ghosts.length / GHOSTS);
    const drawn = ghosts.filter((_, k) => k % every === 0);
    drawn.forEach((pose, k) => this.ghosts.setMatrixAt(k, placed(new THREE.Object3D(), pose).matrix));
    this.ghosts.count = drawn.length;
    this.ghosts.instanceMatrix.needsUpdate = true;
    this.mark(contact ?? {});
  }

  /** Draws the witness points as balls and the normal as an arrow, in front of everything. */
  mark({ witnessA, witnessB, normal }) {
    this.marks.traverse((object) => { object.geometry?.dispose(); object.material?.dispose(); });
    this.marks.clear();
    const ink = getComputedStyle(this.canvas).color;
    for (const point of [witnessA, witnessB]) {
      if (!point) continue;
      const ball = new THREE.Mesh(new THREE.SphereGeometry(0.012), new THREE.MeshBasicMaterial({ color: ink }));
      ball.position.fromArray(point);
      this.marks.add(ball);
    }
    if (normal) this.marks.add(new THREE.ArrowHelper(new THREE.Vector3(...normal), new THREE.Vector3(...witnessA), 0.3, ink, 0.06, 0.03));
    this.marks.traverse(({ material }) => Object.assign(material ?? {}, { depthTest: false, transparent: true }));
  }

  /** Shows the part at a pose. */
  place(pose) {
    placed(this.part, pose);
    this.render();
  }

  render() {
    this.sun.position.copy(camera.position).add(new THREE.Vector3(0, 0, 2));
    this.renderer.render(this.scene, camera);
    document.documentElement.dataset[this.canvas.id] = this.renderer.info.render.triangles > 0 ? "drawn" : "empty";
  }
}

function placed(object, { position, rotation }) {
  object.position.fromArray(position);
  object.quaternion.fromArray(rotation);
  object.updateMatrix();
  return object;
}
