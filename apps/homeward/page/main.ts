// SPDX-License-Identifier: GPL-3.0-or-later
import { onceAFrame } from "./canvas";
import { Link } from "./link";
import { MapView } from "./map_view";
import { drawScan, drawSpeeds, drawView, Sample } from "./pictures";
import { element, showPlace } from "./place_panel";
import { Answer, MapData, Robot, Scan, State, View } from "./types";

const span = 60; // seconds of speeds

function find<Kind extends HTMLElement>(id: string): Kind {
  return document.getElementById(id) as Kind;
}

const link = new Link((open) => {
  connected = open;
  showRobot();
});
const mapView = new MapView(find<HTMLCanvasElement>("map"), (node) => link.withToken(`/view/${node}`));
let connected = false;
let commander = "";
let chosen: number | null = null;
let map: MapData = { file: "", nodes: [], edges: [], edits: [] };
let robot: Robot = { drives: false, stands: false, halting: false, resumable: false, emergency: false, words: "" };
let state: State = { seconds: 0, words: "", why: "", route: [], battery: null, view_age: 0, scan_age: 0 };
let scan: Scan | null = null;
let view: View | null = null;
const viewImage = new Image();
const samples: Sample[] = [];
let events = 0; // reports in this second

// What the program answers

let hide = 0;
function say(words: string, bad: boolean): void {
  const answer = find("answer");
  answer.textContent = words;
  answer.className = bad ? "shown bad" : "shown";
  clearTimeout(hide);
  hide = window.setTimeout(() => (answer.className = ""), 6000); // the words stay
}

async function command(name: string, args: object = {}, take = false): Promise<void> {
  const { status, words } = await link.command(name, args, take);
  say(words, status === 0 || status >= 300);
}

const acts = {
  go: (node: number) => void command("go", { node }),
  rename: (node: number, name: string) => void command("rename", { node, name }),
  close: (node: number, direction: number) => void command("close", { node, direction }),
  forbid: (a: number, b: number) => void command("no-go", { a, b }),
  choose,
};

// What is shown

function commandsElsewhere(): boolean {
  return commander !== "" && commander !== link.client;
}

function showRobot(): void {
  const words = !connected ? "no connection to the program" : robot.emergency ? "Emergency stop" : robot.halting ? "stops …" : robot.stands || !robot.drives ? robot.words : state.words || robot.words;
  find("words").textContent = words;
  find("why").textContent = robot.stands ? "" : state.why;
  find("why").title = state.why;
  const mine = connected && !commandsElsewhere();
  find<HTMLButtonElement>("pause").hidden = robot.stands || !robot.drives;
  find<HTMLButtonElement>("pause").disabled = !connected || robot.halting;
  find<HTMLButtonElement>("resume").hidden = !robot.stands || !robot.drives;
  find<HTMLButtonElement>("resume").disabled = !mine || !robot.resumable || robot.emergency;
  find<HTMLButtonElement>("undo").disabled = !mine || map.edits.length === 0;
  find("undo").title = map.edits.length > 0 ? `Take back: ${map.edits[map.edits.length - 1]}` : "";
  find<HTMLButtonElement>("take").hidden = !connected || !commandsElsewhere();
  find<HTMLButtonElement>("release").hidden = !robot.emergency;
  find<HTMLButtonElement>("release").disabled = !mine;
  find<HTMLButtonElement>("emergency").hidden = !robot.drives;
  find<HTMLButtonElement>("emergency").disabled = !connected || robot.emergency;
  document.body.dataset.robot = robot.emergency ? "emergency" : robot.stands ? "stands" : robot.halting ? "halts" : "drives";
}

function choose(node: number): void {
  chosen = node;
  mapView.choose(node);
  showChosen();
}

function showChosen(): void {
  const place = chosen === null ? undefined : mapView.place(chosen);
  if (!place) return;
  const title = find("placeTitle");
  title.textContent = place.name ? `Place ${place.id}, ${place.name}` : `Place ${place.id}`;
  const into = find("place");
  if (into.contains(document.activeElement) && document.activeElement instanceof HTMLInputElement) return; // somebody writes
  const mine = connected && !commandsElsewhere();
  showPlace(into, place, mapView.waysAt(place.id), link.withToken(`/view/${place.id}`), acts, { edit: mine, go: mine && robot.drives && robot.stands && !robot.emergency });
}

const showView = onceAFrame(() => {
  if (!view) return;
  drawView(find<HTMLCanvasElement>("view"), viewImage, view);
  const places = view.alike.slice(0, 3).map(([node, probability]) => `place ${node}: ${(100 * probability).toFixed(0)} %`);
  find("viewWords").textContent = view.goal ? (view.home === null ? `looks for the way to ${view.goal}` : `the arrow points to ${view.goal}`) : places.length > 0 ? `may be ${places.join(", ")}` : "";
});
const showScan = onceAFrame(() => scan && drawScan(find<HTMLCanvasElement>("scan"), scan));
const showSpeeds = onceAFrame(() => drawSpeeds(find<HTMLCanvasElement>("speed"), samples, span));

function showLog(lines: string[]): void {
  // "Exploration(Homing) 4 - 3 218.2": what, from and to, how unlike they look.
  const rows = lines.map((line) => {
    const parts = /^(.*?) (\d+(?: - \d+)*)(?: -)? ?([\d.]+|-)?$/.exec(line);
    const cells = parts ? [parts[1], parts[2], parts[3] && parts[3] !== "-" ? parts[3] : ""] : [line, "", ""];
    return element("tr", {}, ...cells.map((cell) => element("td", {}, cell)));
  });
  const log = find("log");
  const atEnd = log.scrollTop + log.clientHeight > log.scrollHeight - 30;
  find("lines").replaceChildren(...rows);
  if (atEnd) log.scrollTop = log.scrollHeight;
}

function showAges(): void {
  const near = scan ? Math.min(...scan.ranges.filter((range): range is number => range !== null)) : Infinity;
  const clearance = near < Infinity ? `nearest thing ${near.toFixed(2)} m, ` : "";
  find("scanWords").textContent = scan ? `${clearance}${state.scan_age.toFixed(1)} s old` : "none yet";
  find("health").textContent = [`${state.seconds.toFixed(0)} s`, view && `picture ${state.view_age.toFixed(1)} s old`, `${events} reports a second`,
    state.battery !== null && `battery ${state.battery.toFixed(1)} V`].filter(Boolean).join(", ");
  events = 0;
}

// The timeline

let playing = 0;
function showTime(): void {
  const slider = find<HTMLInputElement>("time");
  const all = Number(slider.value) >= Number(slider.max);
  mapView.showSteps(all ? Infinity : Number(slider.value));
  find("timeWords").textContent = all ? "all of it" : `first ${slider.value} places`;
}

function play(): void {
  const slider = find<HTMLInputElement>("time");
  clearInterval(playing);
  slider.value = "1";
  showTime();
  const steps = Number(slider.max);
  playing = window.setInterval(() => {
    slider.value = String(Number(slider.value) + Math.max(1, Math.round(steps / 200)));
    showTime();
    if (Number(slider.value) >= steps) clearInterval(playing);
  }, 150);
}

// What comes

link.on<MapData>("map", (data) => {
  map = data;
  mapView.setMap(data);
  const slider = find<HTMLInputElement>("time");
  const all = Number(slider.value) >= Number(slider.max);
  slider.max = String(data.nodes.length);
  if (all) slider.value = slider.max;
  showTime();
  const open = data.nodes.reduce((sum, node) => sum + node.directions.filter((direction) => direction.state === "open").length, 0);
  find("counts").textContent = `${data.file}: ${data.nodes.length} places, ${data.edges.length} ways, ${open} open directions`;
  showChosen();
  showRobot();
});
link.on<State>("state", (data) => {
  state = data;
  ++events;
  mapView.setRoute(data.route);
  if (data.told && data.driven) {
    samples.push({ seconds: data.seconds, told: data.told, driven: data.driven, sure: data.sure ?? 0 });
    while (samples[0].seconds < data.seconds - span || samples[0].seconds > data.seconds) samples.shift();
    showSpeeds();
  }
  showRobot();
});
link.on<View>("view", (data) => {
  view = data;
  viewImage.onload = showView;
  viewImage.src = `data:image/jpeg;base64,${data.jpeg}`;
  if (data.alike.length > 0 || data.goal) mapView.setBelief(data.alike);
});
link.on<Scan>("scan", (data) => {
  scan = data;
  showScan();
});
link.on<Robot>("robot", (data) => {
  robot = data;
  showRobot();
  showChosen();
});
link.on<string[]>("log", showLog);
link.on<string>("commander", (data) => {
  commander = data;
  if (commandsElsewhere()) say("somebody else commands now", false);
  showRobot();
  showChosen();
});
link.on<Answer>("answer", (data) => say(data.words, data.status >= 300));

// What somebody does

mapView.onChoose = choose;
mapView.onGo = acts.go;
find("pause").onclick = () => void command("pause");
find("resume").onclick = () => void command("resume");
find("undo").onclick = () => void command("undo");
find("take").onclick = () => void command("take", {}, true);
find("release").onclick = () => void command("release");
find("emergency").onclick = () => void command("emergency-stop");
find("play").onclick = play;
find("time").oninput = () => {
  clearInterval(playing);
  showTime();
};
document.addEventListener("keydown", (event) => {
  if (event.key === "Escape") {
    void command("emergency-stop"); // whatever has the focus
    event.preventDefault();
    return;
  }
  if (event.target instanceof HTMLInputElement || event.ctrlKey || event.altKey || event.metaKey) return;
  if (event.key === "p") void command(robot.stands ? "resume" : "pause");
  else if (event.key === "u") void command("undo");
});
for (const [id, draw] of [["view", showView], ["scan", showScan], ["speed", showSpeeds]] as [string, () => void][]) {
  new ResizeObserver(draw).observe(find(id));
}
setInterval(showAges, 1000);
showRobot();
