// Calls to the server that this page came from. Its token came behind the # of the address, which
// is sent to nobody; it is kept for this tab alone, so that a reload does not lose it.

const KEY = "shapetween-token";
if (location.hash.length > 1) {
  sessionStorage.setItem(KEY, location.hash.slice(1));
  history.replaceState(null, "", location.pathname);
}
const page = crypto.randomUUID ? crypto.randomUUID() : String(Math.random());

export class Refused extends Error {
  constructor(status, line) { super(line); this.status = status; }
}

async function call(path, body, headers = {}) {
  const token = sessionStorage.getItem(KEY) || "";
  const options = { headers: { Authorization: `Bearer ${token}`, "X-Page": page, ...headers } };
  if (body !== undefined) Object.assign(options, { method: "POST", body });
  let answer;
  try {
    answer = await fetch(path, options);
  } catch {
    throw new Refused(0, "The studio does not answer. Has it been ended in the terminal?");
  }
  if (answer.ok) return answer;
  let line = `${answer.status}`;
  try { line = (await answer.json()).error; } catch { /* not our answer */ }
  throw new Refused(answer.status, line);
}

const json = async (path, value) => (await call(path, value && JSON.stringify(value))).json();

export const state = () => json("/api/state");
export const command = (job) => json("/api/command", job);
export const full = (job) => json("/api/full", job);
export const alternatives = (job) => json("/api/alternatives", job);
export const live = (job) => json("/api/live", job);
export const save = async (job) => (await call("/api/save", JSON.stringify(job))).text();

const named = (file) => ({ "X-Name": encodeURIComponent(file.name) });
export const drawing = async (file) => (await call("/api/drawing", await file.arrayBuffer(), named(file))).json();
export const open = async (file) => (await call("/api/open", await file.arrayBuffer(), named(file))).json();

export async function exported(request) {
  const answer = await call("/api/export", JSON.stringify(request));
  return {
    name: decodeURIComponent(answer.headers.get("X-Name")),
    warnings: JSON.parse(decodeURIComponent(answer.headers.get("X-Warnings"))),
    data: await answer.blob(),
  };
}

/** One call at a time; of those that come meanwhile only the latest is made. */
export function latestOnly(make, done, failed) {
  let busy = false, waiting = null;
  const go = async (value) => {
    busy = true;
    try {
      const answer = await make(value);
      if (!waiting) done(answer, value);
      else done(answer, value, true);
    } catch (error) {
      failed(error, value);
    }
    busy = false;
    if (waiting) { const next = waiting; waiting = null; go(next[0]); }
  };
  const ask = (value) => { if (busy) waiting = [value]; else go(value); };
  ask.drop = () => { waiting = null; };
  return ask;
}
