// SPDX-FileCopyrightText: 2026 The wellknit authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The page's own behaviour: light or dark, print, the picture, the links from tables into it.
"use strict";

(() => {
  const root = document.documentElement;
  let viewer = null;
  const darkSystem = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () => root.dataset.theme ? root.dataset.theme === "dark" : darkSystem.matches;
  document.getElementById("theme").addEventListener("click", () => {
    root.dataset.theme = isDark() ? "light" : "dark";
    if (viewer) viewer.redraw();
  });
  darkSystem.addEventListener("change", () => viewer && viewer.redraw());

  // Paper is white: the picture is drawn on it before the print, and as it was after it.
  let theme;
  addEventListener("beforeprint", () => {
    theme = root.dataset.theme;
    root.dataset.theme = "light";
    if (viewer) viewer.drawNow();
  });
  addEventListener("afterprint", () => {
    if (theme)
      root.dataset.theme = theme;
    else
      delete root.dataset.theme;
    if (viewer) viewer.drawNow();
  });

  for (const button of document.querySelectorAll("button.show"))
    button.addEventListener("click", async () => {
      if (!viewer) return;
      document.getElementById("view").scrollIntoView();
      document.getElementById("v-canvas").focus({preventScroll: true});
      await viewer.choose(Number(button.dataset.cell));
    });

  const picture = document.getElementById("picture");
  if (!picture) return;
  (async () => {
    try {
      viewer = new Viewer(JSON.parse(picture.textContent));
      await viewer.open();
      viewer.drawNow();
      root.dataset.picture = "ready";
      root.dataset.readyAfter = String(Math.round(performance.now()));
    } catch (error) {
      root.dataset.picture = "none";
      document.getElementById("v-state").textContent = `No picture: ${error.message}. All figures are on this page.`;
    }
    window.wellknitViewer = viewer;
  })();
})();
