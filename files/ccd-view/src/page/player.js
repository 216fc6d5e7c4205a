// Controls of the time: slider, play, steps by keys, jumps to contacts.
"use strict";

class Player {
  // `show(t)` is called with each new time.
  constructor(element, show) {
    this.show = show;
    [this.slider, this.now, this.button] = ["time", "now", "play"].map(element);
    this.frame = null;
    this.slider.addEventListener("input", () => { this.stop(); this.go((this.slider.value / 1000) * this.duration); });
    this.button.addEventListener("click", () => this.toggle());
  }

  open({ duration, start }, t) {
    this.stop();
    [this.duration, this.start] = [duration, start];
    this.go(t);
  }

  go(t) {
    this.t = t;
    this.slider.value = this.duration > 0 ? Math.round((1000 * t) / this.duration) : 0;
    this.now.textContent = Player.written(this.start + t);
    this.show(t);
  }

  jump(t) {
    this.stop();
    this.go(t);
  }

  toggle() {
    if (this.frame !== null) { this.stop(); return; }
    const from = this.t < this.duration ? this.t : 0;
    let began = null;
    const step = (clock) => {
      began ??= clock;
      const t = Math.min(from + ((clock - began) / 1000 / Player.SECONDS) * this.duration, this.duration);
      this.go(t);
      if (t < this.duration) this.frame = requestAnimationFrame(step);
      else this.stop();
    };
    this.button.textContent = "Pause";
    this.frame = requestAnimationFrame(step);
  }

  stop() {
    if (this.frame !== null) cancelAnimationFrame(this.frame);
    this.frame = null;
    this.button.textContent = "Play";
  }
}

// Returns a time as text, rounded down as in the verdict.
Player.written = (time) => {
  const plain = time === 0 || (Math.abs(time) >= 1e-3 && Math.abs(time) < 1e12);
  if (!plain) return time.toExponential(3);
  const text = time.toFixed(6);
  return Number(text) > time ? (time - 1e-6).toFixed(6) : text;
};

// The seconds on the screen that the whole duration takes.
Player.SECONDS = 4;
