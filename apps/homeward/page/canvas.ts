// SPDX-License-Identifier: GPL-3.0-or-later

/** A canvas that is as sharp as the screen. Returns its size in CSS pixels. */
export function begin(canvas: HTMLCanvasElement): { g: CanvasRenderingContext2D; width: number; height: number } {
  const ratio = window.devicePixelRatio || 1;
  const width = canvas.clientWidth;
  const height = canvas.clientHeight;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const g = canvas.getContext("2d")!;
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = "12px system-ui, 'DejaVu Sans', sans-serif";
  return { g, width, height };
}

/** Draws at most once a frame, however often it is asked to. */
export function onceAFrame(draw: () => void): () => void {
  let asked = false;
  return () => {
    if (!asked) {
      asked = true;
      requestAnimationFrame(() => {
        asked = false;
        draw();
      });
    }
  };
}

/** An arrow head at a point, pointing along `angle` (radians, counter-clockwise, y up). */
export function arrowHead(g: CanvasRenderingContext2D, x: number, y: number, angle: number, size: number): void {
  const at = (turn: number, far: number): [number, number] => [x + far * Math.cos(angle + turn), y - far * Math.sin(angle + turn)];
  g.beginPath();
  g.moveTo(...at(0, size));
  g.lineTo(...at(2.3, 0.7 * size));
  g.lineTo(...at(-2.3, 0.7 * size));
  g.closePath();
}
