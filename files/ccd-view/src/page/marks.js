// Draws a contact: nearest points, normal, highlighted features.
"use strict";

const Marks = (() => {
  const INK = "#111";
  const LIT = { a: "#d55e00", b: "#cc3399" };

  function feature(stage, points, color, size) {
    if (points.length === 1) stage.addBall(points[0], 0.012 * size, color);
    else if (points.length === 2) stage.addBar(points, 0.004 * size, color);
    else stage.addTriangles(points, color);
  }

  // Draws a contact; its marks are relative to `size`, the size of the scene.
  function draw(stage, contact, size) {
    feature(stage, contact.highlight_a, LIT.a, size);
    feature(stage, contact.highlight_b, LIT.b, size);
    if (contact.witnesses === null) return;
    const [a, b] = contact.witnesses;
    for (const point of [a, b]) stage.addBall(point, 0.007 * size, INK);
    if (contact.normal !== null) stage.addArrow(a, contact.normal, 0.15 * size, INK);
  }

  return { draw };
})();
