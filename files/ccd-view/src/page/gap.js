// Plots the distance over time: the measured distance, and below it the proven lower bound.
"use strict";

class GapPlot {
  // `go(t)` is called for a click at a time.
  constructor(holder, go) {
    [this.holder, this.go] = [holder, go];
    holder.addEventListener("click", (event) => {
      if (!this.view) return;
      const box = this.svg.getBoundingClientRect();
      const x = event.clientX - box.left;
      const fraction = Math.min(Math.max((x - GapPlot.LEFT) / (this.right - GapPlot.LEFT), 0), 1);
      this.go(fraction * this.view.duration);
    });
    new ResizeObserver(() => {
      if (this.view && holder.clientWidth !== this.width) { this.open(this.view); this.move(this.t); }
    }).observe(holder);
  }

  open(view) {
    this.view = view;
    this.width = this.holder.clientWidth;
    this.right = this.width - GapPlot.RIGHT;
    const most = Math.max(view.gap?.required ?? 0, ...(view.gap?.points.map((point) => point.upper) ?? [])) || 1;
    this.height = view.gap === null ? 46 : 170;
    this.top = most * 1.05;
    const { gap, contacts, start, duration } = view;
    const parts = [];
    const step = GapPlot.niceStep(duration / (this.width / 160));
    // Counted from the first tick: added to a large start, small steps would be lost to rounding.
    const first = Math.ceil(start / step) * step;
    for (let n = 0; duration > 0 && n < GapPlot.TICKS && first - start + n * step <= duration; n += 1) {
      const x = this.x(first - start + n * step);
      parts.push(`<line class="grid" x1="${x}" x2="${x}" y1="${GapPlot.UP}" y2="${this.floor()}"/><text x="${x}" y="${this.floor() + 16}" text-anchor="middle">${GapPlot.text(first + n * step, step)}</text>`);
    }
    if (gap !== null) parts.push(...this.curves(gap, most));
    for (const contact of contacts) parts.push(`<line class="contact" x1="${this.x(contact.time)}" x2="${this.x(contact.time)}" y1="${GapPlot.UP}" y2="${this.floor()}"/>`);
    for (const ghost of view.ghost_times) parts.push(`<path class="step" d="M${this.x(ghost)},${this.floor()}l-4,7h8z"/>`);
    parts.push(`<line class="floor" x1="${GapPlot.LEFT}" x2="${this.right}" y1="${this.floor()}" y2="${this.floor()}"/>`);
    parts.push(`<line class="now" id="view-cursor" y1="${GapPlot.UP}" y2="${this.floor()}"/>`);
    this.holder.innerHTML = `<svg width="${this.width}" height="${this.height}" role="img" aria-label="Gap between the bodies over time">${parts.join("")}</svg>`;
    this.svg = this.holder.firstChild;
    this.cursor = this.svg.querySelector("#view-cursor");
  }

  curves({ points, proven, unit, required, failing_ranges }, most) {
    // A range that is too short to see is a pixel wide.
    const parts = failing_ranges.map(({ from, to, is_violated }) => `<rect class="${is_violated ? "violated" : "unverified"}" x="${this.x(from)}" width="${Math.max(this.x(to) - this.x(from), 1)}" y="${GapPlot.UP}" height="${this.floor() - GapPlot.UP}"/>`);
    const step = GapPlot.niceStep(most / 4);
    for (let n = 0; n * step <= most; n += 1) {
      const y = this.y(n * step);
      parts.push(`<line class="grid" x1="${GapPlot.LEFT}" x2="${this.right}" y1="${y}" y2="${y}"/><text x="${GapPlot.LEFT - 6}" y="${y + 4}" text-anchor="end">${GapPlot.text(n * step, step)} ${unit ?? ""}</text>`);
    }
    const line = (list) => list.map(([t, g], k) => `${k === 0 ? "M" : "L"}${this.x(t)},${this.y(g)}`).join("");
    const ends = `L${this.x(proven.at(-1)[0])},${this.floor()}L${this.x(proven[0][0])},${this.floor()}Z`;
    parts.push(`<path class="proven-area" d="${line(proven)}${ends}"/><path class="proven" d="${line(proven)}"/>`);
    parts.push(`<path class="gap" d="${line(points.map((point) => [point.time, point.upper]))}"/>`);
    if (required !== null) parts.push(`<line class="required" x1="${GapPlot.LEFT}" x2="${this.right}" y1="${this.y(required)}" y2="${this.y(required)}"/>`);
    return parts;
  }

  move(t) {
    this.t = t;
    const x = this.x(t);
    this.cursor.setAttribute("x1", x);
    this.cursor.setAttribute("x2", x);
  }

  x(t) {
    const { duration } = this.view;
    const fraction = duration > 0 ? t / duration : 0;
    return +(GapPlot.LEFT + fraction * (this.right - GapPlot.LEFT)).toFixed(2);
  }

  y(gap) {
    return +(this.floor() - (gap / this.top) * (this.floor() - GapPlot.UP)).toFixed(2);
  }

  floor() {
    return this.height - 28;
  }

  // 1, 2 or 5 times a power of ten.
  static niceStep(rough) {
    const power = 10 ** Math.floor(Math.log10(rough));
    return power * ([1, 2, 5].find((digit) => digit * power >= rough) ?? 10);
  }

  static text(value, step) {
    if (value === 0) return "0";
    const digits = Math.ceil(-Math.log10(step));
    return digits > 4 || step >= 1e5 || Math.abs(value) >= 1e15 ? value.toExponential(1) : value.toFixed(Math.max(digits, 0));
  }
}

[GapPlot.LEFT, GapPlot.RIGHT, GapPlot.UP, GapPlot.TICKS] = [64, 16, 8, 100];
