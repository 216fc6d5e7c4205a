// A pointer drags the part and throws it; arrow keys move it.

import { Plane, Raycaster, Vector2, Vector3 } from "three";
import { camera } from "./stage.js";

// In metres: the largest distance by which a pointer may miss a part that it takes, and the step of an arrow key.
const [NEAR, STEP] = [0.05, 0.02];
// The velocity is measured over the last `RECENT` milliseconds. There is none if the pointer was held for less than
// `SHORTEST` milliseconds, or is slower than `SLOWEST` metres per second.
const [RECENT, SHORTEST, SLOWEST] = [100, 8, 0.4];
const ARROWS = { ArrowLeft: [-STEP, 0, 0], ArrowRight: [STEP, 0, 0], ArrowUp: [0, STEP, 0], ArrowDown: [0, -STEP, 0] };

/** Calls `grab()`, `hold(position)` and `release(velocity)` for the pointer, and `move(step)` for a key. A part that is put down has no velocity. */
export function makeThrowable({ canvas, part, controls }, { grab, hold, release, move }) {
  // This listener runs before that of the controls, which turn the view.
  canvas.addEventListener("pointerdown", (event) => {
    const { center, radius } = part.geometry.boundingSphere;
    const near = ray(event).distanceToPoint(part.localToWorld(center.clone())) < Math.max(radius, NEAR);
    if (event.button !== 0 || !event.isPrimary || !near) return;
    grab();
    controls.enabled = false;
    const plane = dragPlane();
    const offset = ray(event).intersectPlane(plane, new Vector3())?.sub(part.position) ?? new Vector3();
    const places = [{ time: event.timeStamp, place: part.position.clone() }];
    const follow = (moved) => {
      const place = ray(moved).intersectPlane(plane, new Vector3())?.sub(offset).clampLength(0, 100);
      if (!place) return;
      places.push({ time: moved.timeStamp, place });
      hold(place);
    };
    const ended = new AbortController();
    const end = (velocity) => {
      ended.abort();
      controls.enabled = true;
      release(velocity);
    };
    const handlers = { pointermove: follow, pointerup: (up) => { follow(up); end(velocityOf(places)); }, pointercancel: () => end(null) };
    for (const [name, handler] of Object.entries(handlers)) {
      window.addEventListener(name, (other) => { if (other.pointerId === event.pointerId) handler(other); }, { signal: ended.signal });
    }
    hold(places[0].place);
  }, { capture: true });

  canvas.addEventListener("keydown", (event) => {
    if (!(event.key in ARROWS) || event.shiftKey || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    move(new Vector3(...ARROWS[event.key]).applyQuaternion(camera.quaternion));
  });

  // Returns the plane through the part and the middle of the target that faces the camera most.
  function dragPlane() {
    const eye = camera.getWorldDirection(new Vector3());
    const across = eye.clone().projectOnPlane(part.position);
    return new Plane().setFromNormalAndCoplanarPoint(across.length() > 0.2 ? across.normalize() : eye, part.position);
  }

  function ray({ clientX, clientY }) {
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const caster = new Raycaster();
    caster.setFromCamera(new Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height), camera);
    return caster.ray;
  }
}

function velocityOf(places) {
  const last = places.at(-1);
  const first = places.find(({ time }) => last.time - time <= RECENT);
  const seconds = (last.time - first.time) / 1000;
  const velocity = last.place.clone().sub(first.place).divideScalar(seconds);
  return 1000 * seconds > SHORTEST && velocity.length() > SLOWEST ? velocity : null;
}
