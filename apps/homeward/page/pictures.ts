// SPDX-License-Identifier: GPL-3.0-or-later
import { arrowHead, begin } from "./canvas";
import { colours, Scan, View } from "./types";

/** The panorama with the way home; left of the robot is left of the middle. */
export function drawView(canvas: HTMLCanvasElement, image: HTMLImageElement, view: View): void {
  const { g, width, height } = begin(canvas);
  const high = height - 18;
  g.drawImage(image, 0, 0, width, high);
  const column = (bearing: number): number => {
    const turn = 0.5 - bearing / (2 * Math.PI);
    return (turn - Math.floor(turn)) * width;
  };
  g.fillStyle = colours.faint;
  g.textBaseline = "alphabetic";
  for (const [bearing, words] of [[0, "ahead"], [Math.PI / 2, "left"], [-Math.PI / 2, "right"]] as [number, string][]) {
    g.textAlign = "center";
    g.fillText(words, column(bearing), height - 4);
  }
  if (view.home === null) return;
  const x = column(view.home);
  for (const [colour, grow] of [[colours.white, 3], [colours.route, 0]] as [string, number][]) {
    g.strokeStyle = g.fillStyle = colour;
    g.lineWidth = 6 + grow;
    g.beginPath();
    g.moveTo(x, 0.9 * high);
    g.lineTo(x, 0.45 * high);
    g.stroke();
    arrowHead(g, x, 0.42 * high, Math.PI / 2, 14 + grow);
    g.fill();
  }
}

/** The scan from above, forward up. */
export function drawScan(canvas: HTMLCanvasElement, scan: Scan): void {
  const { g, width, height } = begin(canvas);
  const hits = scan.ranges.filter((range): range is number => range !== null && range < scan.range_max);
  const reach = Math.max(2, ...hits) * 1.08;
  const forward = scan.ranges.every((_, i) => Math.abs(scan.angle_min + i * scan.angle_step) < 1.7);
  const scale = Math.min(width / 2 / reach, (forward ? height - 24 : height / 2) / reach);
  const x0 = width / 2;
  const y0 = forward ? height - 18 : height / 2;
  g.strokeStyle = colours.line;
  g.fillStyle = colours.faint;
  g.textAlign = "left";
  g.textBaseline = "alphabetic";
  const ring = reach > 6 ? 2 : 1;
  for (let r = ring; r < reach; r += ring) {
    g.beginPath();
    g.arc(x0, y0, r * scale, Math.PI, forward ? 2 * Math.PI : 3 * Math.PI);
    g.stroke();
    g.fillText(`${r} m`, x0 + 3, y0 - r * scale - 2);
  }
  for (const [bearing, wide, range] of scan.open) {
    g.fillStyle = colours.open;
    g.globalAlpha = 0.28;
    g.beginPath();
    g.moveTo(x0, y0);
    g.arc(x0, y0, range * scale, -Math.PI / 2 - bearing - wide / 2, -Math.PI / 2 - bearing + wide / 2);
    g.closePath();
    g.fill();
    g.globalAlpha = 1;
    arrowHead(g, x0 - 0.6 * range * scale * Math.sin(bearing), y0 - 0.6 * range * scale * Math.cos(bearing), bearing + Math.PI / 2, 9);
    g.fill();
  }
  g.fillStyle = colours.ink;
  scan.ranges.forEach((range, i) => {
    if (range === null || range >= scan.range_max) return;
    const angle = scan.angle_min + i * scan.angle_step;
    g.fillRect(x0 - range * scale * Math.sin(angle) - 1.5, y0 - range * scale * Math.cos(angle) - 1.5, 3, 3);
  });
  g.fillStyle = colours.route;
  arrowHead(g, x0, y0, Math.PI / 2, 11);
  g.fill();
}

export interface Sample { seconds: number; told: [number, number]; driven: [number, number]; sure: number; }

/** Speed, turn rate and how sure the way home is, one above the other: what was told in gray, the rest in blue. */
export function drawSpeeds(canvas: HTMLCanvasElement, samples: Sample[], span: number): void {
  const { g, width, height } = begin(canvas);
  const end = samples.length > 0 ? samples[samples.length - 1].seconds : 0;
  const third = height / 3;
  const curves: [string, number, number, (sample: Sample) => number | null, (sample: Sample) => number][] = [
    ["m/s", -0.6, 0.6, (sample) => sample.told[0], (sample) => sample.driven[0]],
    ["rad/s, left up", -1, 1, (sample) => sample.told[1], (sample) => sample.driven[1]],
    ["how sure the way home is", 0, 1, () => null, (sample) => sample.sure],
  ];
  curves.forEach(([unit, low, high, told, driven], row) => {
    const y = (value: number): number => third * (row + 1) - 8 - (third - 30) * ((Math.max(low, Math.min(high, value)) - low) / (high - low));
    const x = (seconds: number): number => 34 + (width - 40) * (1 - (end - seconds) / span);
    g.textBaseline = "middle";
    for (const value of [low, (low + high) / 2, high]) {
      g.strokeStyle = colours.line;
      g.lineWidth = 1;
      g.beginPath();
      g.moveTo(34, y(value));
      g.lineTo(width - 6, y(value));
      g.stroke();
      g.fillStyle = colours.faint;
      g.textAlign = "right";
      g.fillText(value.toFixed(1), 30, y(value));
    }
    g.textAlign = "left";
    g.fillText(unit, 38, y(high) - 9);
    for (const [value, colour, wide] of [[told, "#9aa3a9", 3], [driven, colours.way, 1.5]] as [(sample: Sample) => number | null, string, number][]) {
      g.strokeStyle = colour;
      g.lineWidth = wide;
      g.beginPath();
      samples.forEach((sample, i) => {
        const at = value(sample);
        if (at !== null) i === 0 ? g.moveTo(x(sample.seconds), y(at)) : g.lineTo(x(sample.seconds), y(at));
      });
      g.stroke();
    }
  });
}
