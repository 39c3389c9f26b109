// SPDX-License-Identifier: GPL-3.0-or-later
import { arrowHead, begin, onceAFrame } from "./canvas";
import { colours, MapData, Place, Way } from "./types";

const radius = 11; // of a place, CSS pixels

/** The map as a drawing that can be moved, zoomed and clicked. */
export class MapView {
  /** Called when somebody chooses a place. */
  onChoose: (node: number) => void = () => {};
  /** Called when somebody wants to go to the chosen place. */
  onGo: (node: number) => void = () => {};

  private map: MapData = { file: "", nodes: [], edges: [], edits: [] };
  private places = new Map<number, Place>();
  private births: number[] = []; // the step at which each way appears
  private steps = 0;
  private shown = Infinity;
  private route: number[] = [];
  private belief = new Map<number, number>();
  private chosen: number | null = null;
  private scale = 40; // CSS pixels a metre
  private middle = { x: 0, y: 0 }; // metres, of the drawing
  private moved = false; // by hand: it then stays as it is
  private readonly thumbnails = new Map<number, HTMLImageElement>();
  readonly redraw: () => void;

  constructor(private readonly canvas: HTMLCanvasElement, private readonly viewOf: (node: number) => string) {
    this.redraw = onceAFrame(() => this.draw());
    new ResizeObserver(() => this.fit()).observe(canvas);
    this.listen();
  }

  setMap(map: MapData): void {
    this.map = map;
    this.places = new Map(map.nodes.map((node) => [node.id, node]));
    // Numbers grow in time: a way is there after the ways before it and after both its places.
    const index = new Map(map.nodes.map((node, i) => [node.id, i]));
    let last = 0;
    this.births = map.edges.map((way) => (last = Math.max(last, index.get(way.a)!, index.get(way.b)!)));
    this.steps = map.nodes.length;
    if (!this.moved) this.fit();
    this.redraw();
  }

  setRoute(route: number[]): void { this.route = route; this.redraw(); }
  setBelief(alike: [number, number][]): void { this.belief = new Map(alike); this.redraw(); }
  choose(node: number | null): void { this.chosen = node; this.redraw(); }
  /** Shows so many places alone. */
  showSteps(steps: number): void { this.shown = steps; this.redraw(); }
  stepCount(): number { return this.steps; }
  place(node: number): Place | undefined { return this.places.get(node); }

  waysAt(node: number): Way[] {
    return this.map.edges.filter((way) => way.a === node || way.b === node);
  }

  /** Where a place is drawn, CSS pixels of the canvas. */
  pixel(place: { x: number; y: number }): [number, number] {
    return [this.canvas.clientWidth / 2 + (place.x - this.middle.x) * this.scale, this.canvas.clientHeight / 2 - (place.y - this.middle.y) * this.scale];
  }

  /** All of it, in the middle. */
  fit(): void {
    if (this.map.nodes.length > 0 && this.canvas.clientWidth > 0) {
      const xs = this.map.nodes.map((node) => node.x);
      const ys = this.map.nodes.map((node) => node.y);
      const low = { x: xs.reduce((a, b) => Math.min(a, b)), y: ys.reduce((a, b) => Math.min(a, b)) };
      const high = { x: xs.reduce((a, b) => Math.max(a, b)), y: ys.reduce((a, b) => Math.max(a, b)) };
      this.middle = { x: (low.x + high.x) / 2, y: (low.y + high.y) / 2 };
      this.scale = Math.min(90, (this.canvas.clientWidth - 70) / Math.max(high.x - low.x, 0.1), (this.canvas.clientHeight - 70) / Math.max(high.y - low.y, 0.1));
    }
    this.moved = false;
    this.redraw();
  }

  private draw(): void {
    const start = performance.now();
    const { g, width, height } = begin(this.canvas);
    const size = Math.max(3, Math.min(radius, this.scale * 0.4));
    const nodes = this.map.nodes.slice(0, this.shown);
    const there = new Set(nodes.map((node) => node.id));
    this.drawWays(g, there);
    for (const node of nodes) {
      const [x, y] = this.pixel(node);
      if (x < -50 || y < -50 || x > width + 50 || y > height + 50) continue;
      if (size > 5) this.drawDirections(g, node, x, y, size);
      this.drawPlace(g, node, x, y, size);
    }
    this.drawThumbnails(g, nodes, size);
    this.drawScale(g, width, height);
    this.canvas.dataset.drawMs = (performance.now() - start).toFixed(2);
    this.canvas.dataset.nodes = String(nodes.length);
    const chosen = this.chosen === null ? undefined : this.places.get(this.chosen);
    this.canvas.dataset.chosenAt = chosen ? this.pixel(chosen).map(Math.round).join(" ") : "";
  }

  private onRoute(way: Way): boolean {
    return this.route.some((node, i) => i > 0 && ((this.route[i - 1] === way.a && node === way.b) || (this.route[i - 1] === way.b && node === way.a)));
  }

  /** Ways that look alike are one path, as drawing many takes long. */
  private drawWays(g: CanvasRenderingContext2D, there: Set<number>): void {
    const paths = new Map<string, { path: Path2D; colour: string; width: number; dash: number[] }>();
    this.map.edges.forEach((way, i) => {
      if (this.births[i] >= this.shown || !there.has(way.a) || !there.has(way.b)) return;
      const onRoute = this.onRoute(way);
      const reliability = (way.successes + 1) / (way.tries + 1);
      const colour = way.forbidden ? colours.ink : onRoute ? colours.route : colours.way;
      const width = onRoute ? 5 : Math.max(0.8, 2.6 * reliability);
      const key = `${colour} ${width}`;
      if (!paths.has(key)) paths.set(key, { path: new Path2D(), colour, width, dash: way.forbidden ? [2, 5] : [] });
      const { path } = paths.get(key)!;
      path.moveTo(...this.pixel(this.places.get(way.a)!));
      path.lineTo(...this.pixel(this.places.get(way.b)!));
    });
    for (const { path, colour, width, dash } of paths.values()) {
      g.strokeStyle = colour;
      g.lineWidth = width;
      g.setLineDash(dash);
      g.stroke(path);
    }
    g.setLineDash([]);
  }

  private drawDirections(g: CanvasRenderingContext2D, node: Place, x: number, y: number, size: number): void {
    for (const direction of node.directions) {
      const angle = node.heading + direction.bearing;
      arrowHead(g, x + 1.5 * size * Math.cos(angle), y - 1.5 * size * Math.sin(angle), angle, 0.6 * size);
      g.fillStyle = { open: colours.open, driven: colours.way, closed: colours.closed }[direction.state];
      g.fill();
    }
  }

  private drawPlace(g: CanvasRenderingContext2D, node: Place, x: number, y: number, size: number): void {
    const belief = this.belief.get(node.id) ?? 0;
    if (belief > 0.01) {
      g.fillStyle = colours.belief;
      g.globalAlpha = 0.25 + 0.6 * belief;
      g.beginPath();
      g.arc(x, y, size + 4 + 8 * belief, 0, 2 * Math.PI);
      g.fill();
      g.globalAlpha = 1;
    }
    g.beginPath();
    g.arc(x, y, size, 0, 2 * Math.PI);
    g.fillStyle = node.id === this.chosen ? colours.ink : colours.white;
    g.fill();
    g.lineWidth = node.id === this.chosen ? 4 : 2;
    g.strokeStyle = node.id === this.chosen ? colours.open : colours.way;
    g.stroke();
    if (size > 7) {
      g.fillStyle = node.id === this.chosen ? colours.white : colours.ink;
      g.textAlign = "center";
      g.textBaseline = "middle";
      g.fillText(String(node.id), x, y + 0.5);
      if (node.name) {
        const label = node.name.length > 24 ? `${node.name.slice(0, 23)}…` : node.name;
        const wide = g.measureText(label).width + 6;
        g.fillStyle = "rgba(255, 255, 255, 0.85)";
        g.fillRect(x - wide / 2, y + size + 7, wide, 16);
        g.fillStyle = colours.ink;
        g.fillText(label, x, y + size + 15);
      }
    }
  }

  /** What places look like, where there is room for it. */
  private drawThumbnails(g: CanvasRenderingContext2D, nodes: Place[], size: number): void {
    if (this.scale < 55 || nodes.length > 100) return;
    for (const node of nodes) {
      if (!node.view) continue;
      const [x, y] = this.pixel(node);
      const image = this.thumbnail(node.id);
      if (image.complete && image.naturalWidth > 0 && x > -60 && y > -60 && x < this.canvas.clientWidth + 60 && y < this.canvas.clientHeight + 60) {
        g.drawImage(image, x - 36, y - size - 26, 72, 16);
      }
    }
  }

  private thumbnail(node: number): HTMLImageElement {
    let image = this.thumbnails.get(node);
    if (!image) {
      image = new Image();
      image.onload = () => this.redraw();
      image.src = this.viewOf(node);
      this.thumbnails.set(node, image);
    }
    return image;
  }

  private drawScale(g: CanvasRenderingContext2D, width: number, height: number): void {
    const metres = [0.5, 1, 2, 5, 10, 20, 50, 100, 200].find((step) => step * this.scale > 50) ?? 500;
    g.strokeStyle = g.fillStyle = colours.faint;
    g.lineWidth = 2;
    g.beginPath();
    g.moveTo(width - 12 - metres * this.scale, height - 10);
    g.lineTo(width - 12, height - 10);
    g.stroke();
    g.textAlign = "right";
    g.textBaseline = "alphabetic";
    g.fillText(`${metres} m`, width - 12, height - 15);
  }

  private nearest(x: number, y: number): number | null {
    let best: number | null = null;
    let least = 20 * 20;
    for (const node of this.map.nodes.slice(0, this.shown)) {
      const [px, py] = this.pixel(node);
      const far = (px - x) ** 2 + (py - y) ** 2;
      if (far < least) {
        least = far;
        best = node.id;
      }
    }
    return best;
  }

  private zoom(factor: number, x: number, y: number): void {
    const dx = (x - this.canvas.clientWidth / 2) / this.scale;
    const dy = (this.canvas.clientHeight / 2 - y) / this.scale;
    this.scale = Math.min(400, Math.max(2, this.scale * factor));
    this.middle.x += dx - (x - this.canvas.clientWidth / 2) / this.scale;
    this.middle.y += dy - (this.canvas.clientHeight / 2 - y) / this.scale;
    this.moved = true;
    this.redraw();
  }

  /** The place that lies best in a direction from the chosen one. */
  private neighbour(dx: number, dy: number): number | null {
    const from = this.chosen === null ? undefined : this.places.get(this.chosen);
    if (!from) return this.map.nodes[0]?.id ?? null;
    let best: number | null = null;
    let least = Infinity;
    for (const node of this.map.nodes) {
      const along = (node.x - from.x) * dx + (node.y - from.y) * dy;
      const across = Math.abs((node.x - from.x) * dy - (node.y - from.y) * dx);
      if (along > 0.01 && along + 2 * across < least) {
        least = along + 2 * across;
        best = node.id;
      }
    }
    return best;
  }

  private listen(): void {
    let from: { x: number; y: number; far: number } | null = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      from = { x: event.clientX, y: event.clientY, far: 0 };
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!from) return;
      this.middle.x -= (event.clientX - from.x) / this.scale;
      this.middle.y += (event.clientY - from.y) / this.scale;
      from = { x: event.clientX, y: event.clientY, far: from.far + Math.abs(event.clientX - from.x) + Math.abs(event.clientY - from.y) };
      if (from.far > 4) this.moved = true;
      this.redraw();
    });
    this.canvas.addEventListener("pointerup", (event) => {
      const node = from && from.far <= 4 ? this.nearest(event.offsetX, event.offsetY) : null;
      from = null;
      if (node !== null) this.onChoose(node);
    });
    this.canvas.addEventListener("pointercancel", () => (from = null));
    this.canvas.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-0.001 * event.deltaY), event.offsetX, event.offsetY);
    }, { passive: false });
    this.canvas.addEventListener("keydown", (event) => this.key(event));
  }

  private key(event: KeyboardEvent): void {
    const arrows: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    const arrow = arrows[event.key];
    if (arrow) {
      const node = this.neighbour(...arrow);
      if (node !== null) this.onChoose(node);
    } else if (event.key === "Enter" && this.chosen !== null) {
      this.onGo(this.chosen);
    } else if (event.key === "+" || event.key === "-") {
      this.zoom(event.key === "+" ? 1.25 : 0.8, this.canvas.clientWidth / 2, this.canvas.clientHeight / 2);
    } else if (event.key === "0") {
      this.fit();
    } else {
      return;
    }
    event.preventDefault();
  }
}
