// Keeps the keyboard where it is while what it is on is made anew.

/** What an element is called, wherever another one like it may come to stand. */
function called(element: Element): string {
  const row = element.closest("[data-name]")?.getAttribute("data-name") ?? "";
  const own = element.getAttribute("type") ?? "";
  return [element.tagName, own, row, element.getAttribute("value") ?? element.textContent].join("\n");
}

/** Run what replaces elements within these; the focus goes to what is called the same there. */
export function keepingFocus(within: HTMLElement[], replace: () => void): void {
  const focused = document.activeElement;
  const lost = focused && within.some((holder) => holder.contains(focused)) ? called(focused) : null;
  replace();
  if (lost === null || document.activeElement !== document.body) return;
  const offered = within.flatMap((holder) => [...holder.querySelectorAll<HTMLElement>("input, button, summary")]);
  offered.find((element) => called(element) === lost)?.focus();
}
