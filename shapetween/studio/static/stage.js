// The movement: the very SVG that is saved, shown at a time, or playing.

const NEVER = new Set(["script", "foreignobject", "iframe", "audio", "video", "a"]);

/** An SVG's text as an element that can do nothing but be seen. */
export function harmless(text) {
  // Our files hold one style sheet, which shows readers who ask for less motion a still twin. The
  // page's rules let no style sheet in, and here the reader moves it by hand.
  const parsed = new DOMParser().parseFromString(text.replace(/<style>[\s\S]*?<\/style>/g, ""), "image/svg+xml");
  const root = document.importNode(parsed.documentElement, true);
  for (const node of [root, ...root.querySelectorAll("*")]) {
    if (NEVER.has(node.localName.toLowerCase())) { node.remove(); continue; }
    for (const { name, value } of [...node.attributes]) {
      if (/^on/i.test(name)) node.removeAttribute(name);
      else if (/href$/i.test(name) && !/^(#|data:image\/)/i.test(value)) node.removeAttribute(name);
      else if (name === "style") { node.removeAttribute(name); node.style.cssText = value; }
    }
  }
  return root;
}

export class Stage {
  constructor(ids) {
    this.host = ids.stage;
    this.root = this.host.attachShadow({ mode: "open" }); // ids of its own, beside all other SVGs
    this.slider = ids.time;
    this.clock = ids.clock;
    this.button = ids.play;
    this.again = ids.again;
    this.seconds = 1;
    this.time = 0;
    this.playing = false;
    this.still = matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.slider.addEventListener("input", () => { this.pause(); this.seek(Number(this.slider.value) * this.seconds); });
    this.button.addEventListener("click", () => this.toggle());
    document.addEventListener("visibilitychange", () => { this.before = null; });
  }

  /** Show a movement at the same share of its time. */
  show(text, seconds) {
    const share = this.seconds ? this.time / this.seconds : 0;
    const fresh = harmless(text);
    fresh.removeAttribute("width");
    fresh.removeAttribute("height");
    for (const [key, value] of Object.entries({ width: "100%", height: "100%", display: "block" })) fresh.style[key] = value;
    this.seconds = seconds;
    this.svg = fresh;
    this.root.replaceChildren(fresh);
    fresh.pauseAnimations();
    this.seek(share * seconds);
  }

  seek(time) {
    this.time = Math.min(this.seconds, Math.max(0, time));
    // At the very end of what repeats it begins anew; a moment before, the last drawing is there.
    if (this.svg) this.svg.setCurrentTime(Math.min(this.time, this.seconds - 1e-4));
    this.slider.value = this.seconds ? this.time / this.seconds : 0;
    this.slider.setAttribute("aria-valuetext", `${this.time.toFixed(2)} of ${this.seconds.toFixed(2)} seconds`);
    this.clock.textContent = `${this.time.toFixed(2)} s`;
  }

  toggle() { if (this.playing) this.pause(); else this.play(); }

  play() {
    if (!this.svg) return;
    if (this.time >= this.seconds - 1e-3) this.seek(0);
    this.playing = true;
    this.before = null;
    this.mark();
    requestAnimationFrame((now) => this.tick(now));
  }

  pause() { this.playing = false; this.mark(); }

  step(direction) { this.pause(); this.seek(this.time + (direction * this.seconds) / 48); }

  mark() {
    this.button.textContent = this.playing ? "Pause" : "Play";
    this.button.setAttribute("aria-pressed", this.playing);
  }

  tick(now) {
    if (!this.playing) return;
    if (this.before !== null) {
      const next = this.time + (now - this.before) / 1000;
      if (next < this.seconds) this.seek(next);
      else if (this.again.checked) this.seek(next % this.seconds);
      else { this.seek(this.seconds); this.pause(); return; }
    }
    this.before = now;
    requestAnimationFrame((later) => this.tick(later));
  }
}
