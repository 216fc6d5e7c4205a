// The scenes. A part is a body of rigid-ccd and the geometry of three.js that draws it. Lengths are in metres; z is up.

import { Body, readMesh } from "rigid-ccd";
import {
  BoxGeometry, BufferAttribute, BufferGeometry, CapsuleGeometry, ExtrudeGeometry, Float32BufferAttribute, Path, Shape, SphereGeometry, TorusKnotGeometry, Vector2,
} from "three";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";

const bullet = () => capsule(0.025, 0.07);
const coin = () => box(0.2, 0.2, 0.012);
const rod = () => capsule(0.02, 0.6);
const ball = () => sphere(0.12);
const post = () => capsule(0.015, 0.9);
const sheet = () => box(0.002, 0.8, 0.8);

/** The part starts at `position`, with a velocity in metres and turns per second. The target is static at the origin. */
export const SCENES = [
  { name: "A bullet and a sheet of 2 mm", part: bullet, target: sheet, position: [1.02, 0.05, 0.05], velocity: [-9.4, 0, 0], turns: 1 },
  { name: "A coin and a post", part: coin, target: post, position: [1.1, 0.02, 0.1], velocity: [-7, 0, 0], turns: 3 },
  { name: "A spinning rod and a slot", part: rod, target: slottedPlate, position: [1, 0, 0], velocity: [-3, 0, 0], turns: 0.7 },
  { name: "A ball and a sheet", part: ball, target: sheet, position: [1.1, 0, 0], velocity: [-30, 0, 0], turns: 0 },
  { name: "Two knots", part: knot, target: knot, position: [1.1, 0.1, 0.1], velocity: [-2.5, 0, 0], turns: 2 },
];

/** Bodies take half extents, and geometries whole ones. */
function box(...size) {
  return part(Body.box(size.map((length) => length / 2)), new BoxGeometry(...size));
}

function sphere(radius) {
  return part(Body.sphere(radius), new SphereGeometry(radius));
}

/** Makes a capsule along z. Capsules of three.js are along y. `height` is the distance between the centers of the caps. */
function capsule(radius, height) {
  return part(Body.capsule(radius, height / 2), new CapsuleGeometry(radius, height, 12, 32).rotateX(Math.PI / 2));
}

/** The knot of three.js has seams. Normals and texture coordinates keep the vertices of a seam apart. */
function knot() {
  const geometry = new TorusKnotGeometry(0.2, 0.05, 180, 16).deleteAttribute("normal").deleteAttribute("uv");
  return mesh(mergeVertices(geometry));
}

/** Makes a plate across x with a slot along z. */
function slottedPlate() {
  const plate = new Shape(rectangle(0.8, 0.9));
  plate.holes.push(new Path(rectangle(0.12, 0.72)));
  return mesh(new ExtrudeGeometry(plate, { depth: 0.04, bevelEnabled: false }).translate(0, 0, -0.02).rotateX(Math.PI / 2).rotateZ(Math.PI / 2));
}

function rectangle(width, height) {
  const [x, y] = [width / 2, height / 2];
  return [new Vector2(-x, -y), new Vector2(x, -y), new Vector2(x, y), new Vector2(-x, y)];
}

/** Reads a part from a file, and scales it to half a metre around its center. */
export function partOfFile(name, bytes) {
  const { positions, indices } = readMesh(name, bytes, { unit: "m" });
  const geometry = new BufferGeometry().setAttribute("position", new BufferAttribute(positions, 3)).setIndex(new BufferAttribute(indices, 1));
  geometry.center();
  const { min, max } = geometry.boundingBox;
  const scale = 0.5 / min.distanceTo(max);
  return mesh(geometry.scale(scale, scale, scale));
}

/** Makes a part of the triangles of a geometry, with flat shading. Only the body needs double precision. */
function mesh(geometry) {
  const { position } = geometry.attributes;
  const body = Body.fromMesh(position.array, geometry.index?.array);
  geometry.setAttribute("position", new Float32BufferAttribute(position.array, 3));
  const flat = geometry.index ? geometry.toNonIndexed() : geometry;
  flat.computeVertexNormals();
  return part(body, flat);
}

/** `reach` is the largest distance of the part's points from its origin. */
function part(body, geometry) {
  geometry.computeBoundingSphere();
  const { center, radius } = geometry.boundingSphere;
  return { body, geometry, reach: center.length() + radius };
}
