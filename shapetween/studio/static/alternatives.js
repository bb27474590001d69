// The best distinct matchings, each playing small; a click takes one.

import * as api from "./api.js";
import * as state from "./state.js";

export class Alternatives {
  constructor(section, group, say) {
    Object.assign(this, { section, group, say, urls: [], asked: null });
    this.ask = api.latestOnly((job) => api.alternatives(job), (answer, job, late) => { if (!late) this.show(answer, job); }, () => this.clear());
  }

  /** Look for them, unless pins settle the matching, or they are here already. */
  refresh(job) {
    const [leg] = job.legs, options = job.options;
    if (leg.pins.length) { this.ask.drop(); this.asked = null; this.clear(); return; }
    const key = JSON.stringify([job.drawings, leg.matches, options]);
    if (key === this.asked) { this.mark(); return; }
    this.asked = key;
    this.ask({ ...job, legs: [{ ...leg, matching: 1 }] });
  }

  clear() {
    this.section.hidden = true;
    for (const url of this.urls) URL.revokeObjectURL(url);
    this.urls = [];
    this.group.replaceChildren();
  }

  show({ alternatives }, job) {
    this.clear();
    if (JSON.stringify([job.drawings, job.legs[0].matches, job.options]) !== this.asked || alternatives.length < 2) return;
    this.group.append(...alternatives.map(({ svg, matching }) => {
      const made = document.createElement("button"), image = document.createElement("img"), text = document.createElement("span");
      image.src = URL.createObjectURL(new Blob([svg], { type: "image/svg+xml" }));
      this.urls.push(image.src);
      image.alt = "";
      text.textContent = matching === 1 ? "Best" : `No. ${matching}`;
      made.title = matching === 1 ? "The best matching" : `Matching ${matching} (key ${matching})`;
      made.dataset.matching = matching;
      made.append(image, text);
      made.addEventListener("click", () => this.take(matching));
      return made;
    }));
    this.section.hidden = false;
    this.mark();
  }

  take(matching) {
    if (!this.group.querySelector(`[data-matching="${matching}"]`)) return;
    state.settle();
    state.changeLeg(() => ({ matching }));
    this.say(matching === 1 ? "The best matching is taken." : `Matching ${matching} is taken.`);
  }

  mark() {
    const { matching } = state.leg();
    for (const made of this.group.children) made.setAttribute("aria-pressed", Number(made.dataset.matching) === matching);
  }
}
