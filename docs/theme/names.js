// Names for what the theme leaves unnamed, and tables that the keyboard can scroll.
function complete() {
  document.querySelector(".md-search")?.setAttribute("aria-label", "Search");
  document.querySelectorAll(".md-code__nav").forEach((buttons, i) => {
    buttons.setAttribute("aria-label", `Example ${i + 1}`);
  });
  document.querySelectorAll(".md-typeset__scrollwrap").forEach((table) => {
    table.tabIndex = 0;
  });
}

complete();
new MutationObserver(complete).observe(document.body, { childList: true, subtree: true });
