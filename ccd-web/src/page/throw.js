// What a pointer throws: a velocity from its last places.
"use strict";

const Throw = (() => {
  // Places older than this, in milliseconds, say nothing about the speed at the end.
  const RECENT = 100;
  // The least time, in seconds, over which a speed is taken.
  const SHORTEST = 0.008;
  // Slower than this, in metres per second, is put down rather than thrown.
  const SLOWEST = 0.4;

  // The velocity, per second, of places { at: milliseconds, place: [x, y, z] }; none when they are too slow.
  function velocity(places) {
    const last = places[places.length - 1];
    const first = places.find(({ at }) => last.at - at <= RECENT);
    const seconds = (last.at - first.at) / 1000;
    // Events that come together say nothing about their speed.
    if (!(seconds > SHORTEST)) return null;
    const found = last.place.map((p, k) => (p - first.place[k]) / seconds);
    return Math.hypot(...found) > SLOWEST ? found : null;
  }

  return { velocity };
})();
