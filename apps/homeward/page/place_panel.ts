// SPDX-License-Identifier: GPL-3.0-or-later
import { Place, Way } from "./types";

/** What can be asked for at a place. */
export interface PlaceActs {
  go(node: number): void;
  rename(node: number, name: string): void;
  close(node: number, direction: number): void;
  forbid(a: number, b: number): void;
  choose(node: number): void;
}

type Children = (Node | string)[];

/** An element; text is never read as HTML. */
export function element<Tag extends keyof HTMLElementTagNameMap>(tag: Tag, properties: Partial<HTMLElementTagNameMap[Tag]> = {}, ...children: Children): HTMLElementTagNameMap[Tag] {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

function button(words: string, then: () => void, disabled = false): HTMLButtonElement {
  return element("button", { type: "button", onclick: then, disabled }, words);
}

function degrees(angle: number): string {
  const turn = Math.round((angle * 180) / Math.PI);
  return `${Math.abs(turn)}° ${turn === 0 ? "ahead" : turn > 0 ? "left" : "right"}`;
}

function renaming(place: Place, acts: PlaceActs, may: boolean): HTMLFormElement {
  const input = element("input", { id: "name", value: place.name, maxLength: 60, placeholder: "name, for example kitchen" });
  input.setAttribute("aria-label", "Name of this place");
  const form = element("form", {}, input, element("button", { disabled: !may }, "Name it"));
  form.onsubmit = (event) => {
    event.preventDefault();
    acts.rename(place.id, input.value.trim());
  };
  return form;
}

/** All that is known of one place. */
export function showPlace(into: HTMLElement, place: Place, ways: Way[], image: string, acts: PlaceActs, may: { edit: boolean; go: boolean }): void {
  const rows = ways.map((way) => {
    const other = way.a === place.id ? way.b : way.a;
    const drives = way.tries > 0 ? `arrived ${way.successes} of ${way.tries}${way.successes > 0 ? `, ${way.seconds.toFixed(0)} s` : ""}` : "not driven again yet";
    const words = [way.length === null ? "" : `${way.length.toFixed(1)} m`, drives, way.error && `last failure: ${way.error}`, way.forbidden && "no-go"].filter(Boolean).join(", ");
    return element("tr", {}, element("td", {}, button(`place ${other}`, () => acts.choose(other))), element("td", {}, words),
      element("td", {}, button(way.forbidden ? "May be driven" : "No-go", () => acts.forbid(place.id, other), !may.edit)));
  });
  const directions = place.directions.map((direction, i) =>
    element("tr", {}, element("td", {}, degrees(direction.bearing)), element("td", {}, direction.state + (direction.reason ? `: ${direction.reason}` : "")),
      element("td", {}, ...(direction.state === "open" ? [button("Close", () => acts.close(place.id, i), !may.edit)] : []))));
  into.replaceChildren(
    ...(place.view ? [element("img", { src: image, alt: `Panorama of place ${place.id}` })] : []),
    element("div", { className: "acts" }, element("button", { id: "go", type: "button", disabled: !may.go, onclick: () => acts.go(place.id) }, "Go there")),
    renaming(place, acts, may.edit),
    element("table", {}, element("thead", {}, element("tr", {}, element("th", {}, "way to"), element("th", {}, "drives"), element("th", {}))), element("tbody", {}, ...rows)),
    element("table", {}, element("thead", {}, element("tr", {}, element("th", {}, "direction"), element("th", {}, "state"), element("th", {}))), element("tbody", {}, ...directions)),
  );
}
