(() => {
  const folds = [...document.querySelectorAll("details.fold")];
  const contents = document.querySelector("details.contents");
  const links = [...document.querySelectorAll("nav a")];
  const narrow = window.matchMedia("(max-width: 1000px)");

  /** Open what a link leads to, and go there. */
  function reveal(hash) {
    const target = hash.length > 1 && document.getElementById(decodeURIComponent(hash.slice(1)));
    if (!target) return;
    const fold = target.querySelector(":scope > details.fold") || target.closest("details.fold");
    if (fold) fold.open = true;
    target.scrollIntoView();
  }

  // Contents stand beside a wide page and are folded above a narrow one.
  const place = () => { contents.open = !narrow.matches; };
  narrow.addEventListener("change", place);
  place();

  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#']");
    if (!link) return;
    if (narrow.matches) contents.open = false;
    reveal(link.hash);
  });
  window.addEventListener("hashchange", () => reveal(location.hash));
  reveal(location.hash);

  document.querySelector(".folds").hidden = false;
  document.querySelectorAll("[data-folds]").forEach((button) => {
    button.addEventListener("click", () => folds.forEach((one) => { one.open = button.dataset.folds === "open"; }));
  });

  // Paper cannot be unfolded.
  let closed = [];
  window.addEventListener("beforeprint", () => {
    closed = folds.filter((one) => !one.open);
    closed.forEach((one) => { one.open = true; });
  });
  window.addEventListener("afterprint", () => closed.forEach((one) => { one.open = false; }));

  // The section in view is marked in the contents.
  const sections = links.map((link) => document.getElementById(link.hash.slice(1)));
  const mark = () => {
    const past = sections.filter((one) => one && one.getBoundingClientRect().top < 0.3 * window.innerHeight);
    const current = past.length ? past[past.length - 1] : sections[0];
    links.forEach((link, k) => {
      if (sections[k] === current) link.setAttribute("aria-current", "true"); else link.removeAttribute("aria-current");
    });
  };
  window.addEventListener("scroll", mark, { passive: true });
  mark();

  document.documentElement.dataset.ready = performance.now().toFixed(0);
})();
