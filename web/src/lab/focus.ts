// Keeps the keyboard focus while the focused element is replaced.

/** The identity of an element, shared by its replacement. */
function called(element: Element): string {
  const row = element.closest("[data-name]")?.getAttribute("data-name") ?? "";
  const own = element.getAttribute("type") ?? "";
  return [element.tagName, own, row, element.getAttribute("value") ?? element.textContent].join("\n");
}

/** Replace elements within these, and restore the focus to the element with the same identity. */
export function keepingFocus(within: HTMLElement[], replace: () => void): void {
  const focused = document.activeElement;
  const lost = focused && within.some((holder) => holder.contains(focused)) ? called(focused) : null;
  replace();
  if (lost === null || document.activeElement !== document.body) return;
  const offered = within.flatMap((holder) => [...holder.querySelectorAll<HTMLElement>("input, button, summary")]);
  offered.find((element) => called(element) === lost)?.focus();
}
