// The keyboard. What a field does with a key is the field's own.

const TYPING = "input:not([type=range]):not([type=checkbox]), select, textarea";

export function listen(actions) {
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]")) return;
    const typing = event.target.closest && event.target.closest(TYPING);
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    let name = key;
    if (event.ctrlKey || event.metaKey) name = `Ctrl+${event.shiftKey ? "Shift+" : ""}${key}`;
    else if (typing || event.altKey) return;
    else if (key === " " && event.target.closest && event.target.closest("button")) return;
    else if ((key === "Home" || key === "End") && event.target.closest("[role=slider], input")) return;
    const action = actions[name];
    if (!action || (typing && /z|y/.test(key))) return;
    event.preventDefault();
    action();
  });
}
