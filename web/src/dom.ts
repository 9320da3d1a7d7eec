// Elements are created one by one, so that text is never parsed as HTML.

type Attributes = Record<string, string | number | boolean>;

export function make<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== false) element.setAttribute(name, value === true ? "" : String(value));
  }
  element.append(...children);
  return element;
}

const SVG = "http://www.w3.org/2000/svg";

/** An element of a drawing. */
export function drawn<K extends keyof SVGElementTagNameMap>(tag: K, attributes: Attributes = {}, ...children: (Node | string)[]): SVGElementTagNameMap[K] {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, String(value));
  element.append(...children);
  return element;
}

const MATH = "http://www.w3.org/1998/Math/MathML";
const TAGS = new Set(
  "math mrow mi mn mo ms mtext mspace mfrac msqrt mroot msup msub msubsup mover munder munderover mstyle mpadded mtable mtr mtd".split(" "),
);
const KEPT = new Set(
  "displaystyle display form fence stretchy width height lspace rspace mathvariant accent separator minsize maxsize".split(" "),
);

/** A formula; anything other than plain MathML is dropped. */
export function formula(mathml: string): Node {
  const parsed = new DOMParser().parseFromString(mathml, "text/html").body.firstElementChild;
  return parsed ? clean(parsed) : document.createTextNode("");
}

function clean(element: Element): Node {
  if (!TAGS.has(element.localName)) return document.createTextNode(element.textContent ?? "");
  const copy = document.createElementNS(MATH, element.localName);
  for (const { name, value } of element.attributes) {
    if (KEPT.has(name)) copy.setAttribute(name, value);
  }
  for (const child of element.childNodes) {
    copy.append(child instanceof Element ? clean(child) : (child.textContent ?? ""));
  }
  return copy;
}

/** Four digits, with powers of ten where needed. */
export function digits(value: number, count = 4): string {
  if (value === 0) return "0";
  const size = Math.abs(value);
  if (size >= 1e-3 && size < 1e5) return String(Number(value.toPrecision(count))).replace("-", "−");
  const [mantissa, exponent] = value.toExponential(count - 1).split("e");
  const raised = [...String(Number(exponent))].map((c) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(c)] ?? "⁻").join("");
  return `${Number(mantissa)}·10${raised}`.replace(/^-/, "−");
}

/** With superscripts, as in m/s². */
export function raised(text: string): string {
  return text.replace(/\^(\d)/g, (_, digit: string) => "⁰¹²³⁴⁵⁶⁷⁸⁹"[Number(digit)]);
}

const LATEST = 250; // ms; what is out of sight, such as a frame that was scrolled away, is not painted at all

/** Resolves once the page has been painted, or would have been. */
export function painted(): Promise<void> {
  return new Promise((done) => {
    requestAnimationFrame(() => setTimeout(done));
    setTimeout(done, LATEST);
  });
}

/** Numbers with as many digits as needed to distinguish them. */
export function apart(ticks: number[], fewest = 4): string[] {
  for (let count = fewest; count < 15; count++) {
    const told = ticks.map((tick) => digits(tick, count));
    if (new Set(told).size === new Set(ticks).size) return told;
  }
  return ticks.map(String);
}
