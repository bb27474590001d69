// Fields for the options, drawn from the server's own table, and the command line.

import * as state from "./state.js";

const OWN = "own";

export class Panel {
  constructor(form, settings) {
    this.fields = settings.map((setting) => this.field(form, setting));
    form.addEventListener("submit", (event) => event.preventDefault());
  }

  field(form, setting) {
    const label = document.createElement("label");
    label.textContent = setting.label;
    const input = setting.choices.length ? choices(setting) : number(setting);
    input.id = `set-${setting.name}`;
    label.append(input);
    form.append(label);
    const own = setting.kind === "easing" ? ownEasing(label) : null;
    const changed = () => {
      state.settle();
      const value = read(setting, input, own);
      if (value === undefined) return;
      state.change((s) => {
        const { [setting.name]: _, ...options } = s.options;
        if (value !== setting.default) options[setting.name] = value;
        return { ...s, options };
      });
    };
    input.addEventListener("change", changed);
    if (own) own.addEventListener("change", changed);
    return { setting, input, own, label };
  }

  /** Show what is set. */
  show(options) {
    for (const { setting, input, own, label } of this.fields) {
      label.hidden = Boolean(setting.needs) && !(setting.needs in options);
      const value = setting.name in options ? options[setting.name] : setting.default;
      if (own) {
        const known = setting.choices.includes(value);
        input.value = known ? value : OWN;
        own.hidden = known;
        if (!known) own.value = value;
      } else input.value = value === null ? "" : value;
    }
  }
}

function choices(setting) {
  const select = document.createElement("select");
  if (setting.none) select.append(new Option(setting.none, ""));
  for (const choice of setting.choices) select.append(new Option(choice, choice));
  if (setting.kind === "easing") select.append(new Option("own curve…", OWN));
  return select;
}

function number(setting) {
  const input = document.createElement("input");
  Object.assign(input, { type: "number", min: setting.low, max: setting.high, step: setting.kind === "whole" ? 1 : "any" });
  if (setting.default === null) input.placeholder = "as few as needed";
  return input;
}

function ownEasing(label) {
  const input = document.createElement("input");
  Object.assign(input, { type: "text", hidden: true, placeholder: "cubic-bezier(.2, 0, 0, 1)" });
  input.setAttribute("aria-label", "Easing curve");
  label.after(input);
  return input;
}

function read(setting, input, own) {
  if (own) {
    own.hidden = input.value !== OWN;
    if (input.value !== OWN) return input.value;
    if (!own.value) { own.focus(); return undefined; }
    return own.value;
  }
  if (setting.choices.length) return input.value || setting.default;
  if (input.value === "") return setting.default;
  const value = Number(input.value);
  return Number.isFinite(value) ? value : undefined;
}
