// SPDX-License-Identifier: GPL-3.0-or-later
// What the program sends; see dashboard_json.cpp. Metres, radians counter-clockwise, seconds.

export interface Direction { bearing: number; width: number; state: "open" | "driven" | "closed"; reason: string; }
export interface Place { id: number; name: string; x: number; y: number; heading: number; view: boolean; directions: Direction[]; }
export interface Way { a: number; b: number; length: number | null; tries: number; successes: number; seconds: number; error: string; forbidden: boolean; }
export interface MapData { file: string; nodes: Place[]; edges: Way[]; edits: string[]; }
export interface State { seconds: number; words: string; why: string; route: number[]; battery: number | null; view_age: number; scan_age: number; sure?: number; told?: [number, number]; driven?: [number, number]; }
export interface View { jpeg: string; goal: string; home: number | null; alike: [number, number][]; }
export interface Scan { angle_min: number; angle_step: number; range_max: number; ranges: (number | null)[]; open: [number, number, number][]; }
export interface Robot { drives: boolean; stands: boolean; halting: boolean; resumable: boolean; emergency: boolean; words: string; }
export interface Answer { command: string; status: number; words: string; }

export const colours = {
  ink: "#26323a", faint: "#5d6b75", line: "#d5dbe0", way: "#0072b2", open: "#e69f00", route: "#b8004d", closed: "#8b949a", belief: "#56b4e9", white: "#ffffff",
};
