// Saving: the movement in every form the tool writes, and the project.

import * as api from "./api.js";
import * as state from "./state.js";

const FIELDS = {
  size: ["Longer side, pixels", 800], fps: ["Frames a second", 30], frames: ["Frames a leg", 24], background: ["Background", ""],
};

/** Hand a file to the reader. */
export function download(name, data) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(data);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60_000);
}

export class Exporter {
  constructor(dialog, ids, forms) {
    Object.assign(this, { dialog, ...ids, forms });
    const label = document.createElement("label");
    label.textContent = "Form";
    this.form = document.createElement("select");
    this.form.id = "export-form";
    for (const [key, { label: text, ending }] of Object.entries(forms)) this.form.append(new Option(`${text} (${ending.split(".").at(-1)})`, key));
    label.append(this.form);
    this.inputs = Object.fromEntries(Object.entries(FIELDS).map(([key, [text, value]]) => [key, this.field(key, text, value)]));
    this.fields.prepend(label);
    this.form.addEventListener("change", () => this.draw());
    this.go.addEventListener("click", () => this.run());
    this.draw();
  }

  field(key, text, value) {
    const label = document.createElement("label"), input = document.createElement("input");
    label.textContent = text;
    Object.assign(input, { id: `export-${key}`, type: key === "background" ? "text" : "number", value, placeholder: key === "background" ? "none" : "" });
    label.append(input);
    this.fields.append(label);
    return input;
  }

  open() { this.say(""); this.draw(); this.dialog.showModal(); }

  draw() {
    const { takes } = this.forms[this.form.value];
    for (const [key, input] of Object.entries(this.inputs)) input.parentElement.hidden = !takes.includes(key);
    const drawings = new Set(state.current().drawings);
    const one = state.current().legs.length > 1 && ["mesh", "mesh.json"].includes(this.form.value);
    this.go.disabled = one;
    if (one) this.say(`A mesh is of two drawings, and here are ${drawings.size}.`, true);
    else if (!this.go.dataset.busy) this.say("");
  }

  say(text, error = false) {
    this.status.textContent = text;
    this.status.classList.toggle("error", error);
  }

  async run() {
    const output = {};
    for (const key of this.forms[this.form.value].takes) {
      const { value, type } = this.inputs[key];
      if (value !== "") output[key] = type === "number" ? Number(value) : value;
    }
    this.go.disabled = true;
    this.go.dataset.busy = "1";
    this.say("Working…");
    try {
      const made = await api.exported({ job: state.job(), form: this.form.value, output });
      download(made.name, made.data);
      const size = made.data.size < 1e6 ? `${Math.ceil(made.data.size / 1e3)} kB` : `${(made.data.size / 1e6).toFixed(1)} MB`;
      this.say([`Saved ${made.name}, ${size}.`, ...made.warnings].join(" "));
    } catch (error) {
      this.say(error.message, true);
    }
    delete this.go.dataset.busy;
    this.go.disabled = false;
  }
}
