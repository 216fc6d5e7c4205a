// Bodies from shapes, arrays and files; memory and errors.

/** A cube of side 2 as three.js makes a `BoxGeometry`: four corners for each face. */
function cubeOfThree() {
  const [positions, indices] = [[], []];
  for (let axis = 0; axis < 3; axis += 1) {
    for (const side of [-1, 1]) {
      const first = positions.length / 3;
      for (const [u, v] of [[-1, -1], [side, -side], [1, 1], [-side, side]]) {
        const corner = [0, 0, 0];
        [corner[axis], corner[(axis + 1) % 3], corner[(axis + 2) % 3]] = [side, u, v];
        positions.push(...corner);
      }
      indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
  }
  return { positions: new Float32Array(positions), indices: new Uint16Array(indices) };
}

const TETRAHEDRON = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

/** A tetrahedron in glTF, whose data is in a buffer of its own by default. */
function gltf(buffer) {
  const positions = new Uint8Array(new Float32Array([0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1]).buffer);
  const indices = new Uint8Array([0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3]);
  const data = btoa(String.fromCharCode(...positions, ...indices));
  const scene = {
    asset: { version: "2.0" },
    buffers: [{ byteLength: 60, uri: `data:application/octet-stream;base64,${data}`, ...buffer }],
    bufferViews: [{ buffer: 0, byteLength: 48 }, { buffer: 0, byteOffset: 48, byteLength: 12 }],
    accessors: [
      { bufferView: 0, componentType: 5126, count: 4, type: "VEC3", min: [0, 0, 0], max: [1, 1, 1] },
      { bufferView: 1, componentType: 5121, count: 12, type: "SCALAR" },
    ],
    meshes: [{ primitives: [{ attributes: { POSITION: 0 }, indices: 1 }] }],
    nodes: [{ mesh: 0 }],
  };
  return new TextEncoder().encode(JSON.stringify(scene));
}

export default (ccd, { equal, ok, between, throws }) => ({
  "the index of three.js makes a solid of one piece"() {
    const { positions, indices } = cubeOfThree();
    const [cube, ball] = [ccd.Body.fromMesh(positions, indices), ccd.Body.sphere(0.5)];
    equal([cube.isSolid, cube.excess], [true, 0]);
    ok(/closed|solid/.test(cube.report), cube.report);
    // Inside a solid nothing touches its surface, and yet they overlap.
    equal(ccd.firstContact(ball, cube).kind, "overlapping");
    const { lower, upper } = ccd.distance(ball, cube, { motionA: { position: [3, 0, 0] } });
    between(1.5, lower, upper);
    between(upper - lower, 0, 1e-3);
    const hollow = ccd.Body.fromMesh(positions, indices, { surface: true });
    equal([hollow.isSolid, ccd.firstContact(ball, hollow).kind], [false, "free"]);
  },
  "arrays of all kinds, with indices and without, are the same mesh"() {
    const { positions, indices } = cubeOfThree();
    const loose = [...indices].flatMap((index) => [...positions.subarray(3 * index, 3 * index + 3)]);
    const cubes = [
      ccd.Body.fromMesh(positions, indices),
      ccd.Body.fromMesh(new Float64Array(positions), Uint32Array.from(indices)),
      ccd.Body.fromMesh([...positions], [...indices]),
      ccd.Body.fromMesh(new Float32Array(loose)),
    ];
    const ball = ccd.Body.sphere(0.5);
    const fall = { motionA: { position: [0.3, 0.2, 4], velocity: [0, 0, -3] } };
    const times = cubes.map((cube) => ccd.firstContact(ball, cube, fall).time);
    equal(new Set(times).size, 1);
    between(times[0], 2.5 / 3 - 1e-3, 2.5 / 3);
  },
  "files of all formats are read"() {
    const bytes = (text) => new TextEncoder().encode(text);
    const vertices = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
    const faces = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    const ply = `ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 4\nproperty list uchar int vertex_indices\nend_header\n${vertices}${faces}`;
    const corners = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]];
    const facet = (face) => `facet normal 0 0 0\nouter loop\n${face.map((k) => `vertex ${corners[k].join(" ")}\n`).join("")}endloop\nendfacet\n`;
    const stl = `solid s\n${[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]].map(facet).join("")}endsolid s\n`;
    const dae = `<COLLADA version="1.5.0"><library_geometries><geometry><mesh><source id="s"><float_array id="a">${vertices}</float_array><technique_common><accessor source="#a" count="4" stride="3"/></technique_common></source><vertices id="v"><input semantic="POSITION" source="#s"/></vertices><triangles count="4"><input semantic="VERTEX" source="#v"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles></mesh></geometry></library_geometries></COLLADA>`;
    const files = { "a.obj": TETRAHEDRON, "a.off": `OFF\n4 4 0\n${vertices}${faces}`, "a.ply": ply, "a.stl": stl, "a.gltf": new TextDecoder().decode(gltf()), "a.dae": dae };
    for (const [name, text] of Object.entries(files)) {
      const body = ccd.Body.fromFile(name, bytes(text), { scale: 2 });
      const { lower, upper } = ccd.distance(body, ccd.Body.sphere(1), { motionB: { position: [0, 0, 5] } });
      equal([ccd.readMesh(name, bytes(text)).positions.length, ccd.readMesh(name, bytes(text)).indices.length], [12, 12]);
      ok(body.isSolid && lower <= 2 && upper >= 2 && upper - lower < 1e-3, `${name}: ${lower} to ${upper}`);
    }
  },
  "round shapes say by how much they are exceeded"() {
    const cylinder = ccd.Body.cylinder(1, 2, 1e-4);
    between(cylinder.excess, 1e-6, 1e-4);
    between(ccd.Body.cone(1, 2).excess, 1e-6, 1 / 4096);
    const { lower, upper } = ccd.distance(cylinder, ccd.Body.capsule(0.5, 1), { motionB: { position: { x: 3, y: 0, z: 0 } } });
    between(1.5, lower, upper);
  },
  "errors name the element"() {
    const { positions, indices } = cubeOfThree();
    throws(() => ccd.Body.fromMesh(positions, [0, 1, 99]), /99/);
    throws(() => ccd.Body.fromMesh([0, 0, 0, 1, 0, NaN, 0, 1, 0], [0, 1, 2]), /positions\[5\]/);
    throws(() => ccd.Body.fromMesh([0, 0, 0, 1, 0, 1e13, 0, 1, 0], [0, 1, 2]), /vertex 1/);
    throws(() => ccd.Body.fromMesh(positions, [0, 1]), /indices: 2 numbers/);
    throws(() => ccd.Body.fromMesh(positions, [0, 1, -2]), /indices\[2\]/);
    throws(() => ccd.Body.fromMesh(positions, indices, { peices: "hull" }), /no "peices"/);
    throws(() => ccd.Body.fromMesh(positions, indices, { pieces: "cubes" }), /pieces: "cubes"/);
    throws(() => ccd.Body.fromFile("a.obj", new TextEncoder().encode("v 1 2\n")), /a\.obj.*line 1/);
    throws(() => ccd.Body.fromFile("a.txt", new Uint8Array()), /txt.*; use \.gltf, \.glb, \.dae, \.obj, \.stl, \.ply or \.off$/);
    throws(() => ccd.Body.fromFile("a.fbx", new Uint8Array()), /export it as \.glb$/);
    throws(() => ccd.Body.fromFile("a.gltf", gltf({ uri: "a.bin" })), /a\.bin/);
    throws(() => ccd.Body.sphere(-1), /radius/);
    throws(() => ccd.Body.box([1, 2]), /halfExtents/);
    throws(() => new ccd.Body(), /Body\.fromMesh/);
  },
  "what is freed is gone, and its memory is used again"() {
    const { positions, indices } = cubeOfThree();
    const ball = ccd.Body.sphere(1);
    ball.free();
    ball.free();
    throws(() => ccd.firstContact(ball, ball), /this Body was freed/);
    const count = 3000;
    const round = () => {
      for (let k = 0; k < count; k += 1) ccd.Body.fromMesh(positions, indices).free();
    };
    round();
    const before = ccd.memoryUsage();
    round();
    equal(ccd.memoryUsage(), before);
    if (Symbol.dispose) {
      const disposed = ccd.Body.sphere(1);
      disposed[Symbol.dispose]();
      throws(() => disposed.report, /freed/);
    }
  },
});
