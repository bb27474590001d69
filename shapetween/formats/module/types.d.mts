/** Path data at a time from 0 to 1, of one part of the drawing, counted from 0 in paint order. */
export default function d(t: number, part?: number): string;

/** Attributes of that part: paint, widths, opacity. */
export function style(t: number, part?: number): Record<string, string>;

/** What `viewBox` of an <svg> must be. */
export declare const viewBox: string;

/** Names of the parts, empty where a part has none. */
export declare const parts: string[];

export interface Timing {
  /** Milliseconds of each way, from each drawing to the next. */
  duration: number;
  /** Of each way, as CSS has it. */
  easing: string;
  loop: "once" | "repeat" | "alternate";
  /** Milliseconds that each drawing stands still. */
  hold: number;
  /** What it waits for: as the file was written, whatever `play` is told. */
  start: "load" | "click" | "hover" | "seen" | "scroll" | "drag";
}

/** What `play` does where it is not told otherwise. */
export declare const timing: Timing;

/** Draw into an <svg>, a <g>, or an element that is given an <svg>; shows any time from 0 to 1. */
export function mount(target: Element | string): (t: number) => void;

export interface PlayOptions extends Partial<Omit<Timing, "start">>, Omit<KeyframeEffectOptions, "duration" | "easing"> {
  /** Which part a <path> as target shows. */
  part?: number;
  /** A ScrollTimeline or ViewTimeline to follow instead of the clock. */
  timeline?: AnimationTimeline;
}

/** Play in an element; pause, reverse, seek and await it as any Animation. */
export function play(target: Element | string, options?: PlayOptions): Animation;
