"use strict";
// Figures enlarge on a click or Enter. Enlarged, the wheel and + and - zoom about the pointer or the
// middle, dragging and the arrow keys move, 0 shows all, Escape closes.
(() => {
  const dialog = document.getElementById("zoom");
  if (!dialog || !dialog.showModal) return;
  const stage = dialog.querySelector(".drawing");
  const kStep = 1.25;
  const kLargest = 40;
  let whole = null;  // the viewBox that shows all: x, y, width, height
  let view = null;
  let svg = null;

  const show = () => svg.setAttribute("viewBox", view.join(" "));
  // Keeps the view within the figure, and no larger than it.
  const settle = () => {
    const scale = Math.min(Math.max(view[2] / whole[2], 1 / kLargest), 1);
    const middle = [view[0] + view[2] / 2, view[1] + view[3] / 2];
    view[2] = whole[2] * scale;
    view[3] = whole[3] * scale;
    for (const k of [0, 1]) {
      const low = middle[k] - view[k + 2] / 2;
      view[k] = Math.min(Math.max(low, whole[k]), whole[k] + whole[k + 2] - view[k + 2]);
    }
    show();
  };
  // About a point of the figure; the middle without one.
  const zoom = (factor, about) => {
    const scale = Math.min(Math.max(view[2] / factor / whole[2], 1 / kLargest), 1);
    const actual = view[2] / (whole[2] * scale);
    const at = about || [view[0] + view[2] / 2, view[1] + view[3] / 2];
    view = [at[0] - (at[0] - view[0]) / actual, at[1] - (at[1] - view[1]) / actual,
            view[2] / actual, view[3] / actual];
    settle();
  };
  const move = (dx, dy) => {
    view[0] += dx * view[2];
    view[1] += dy * view[3];
    settle();
  };
  const pointOf = (event) => {
    const matrix = svg.getScreenCTM();
    if (!matrix) return null;
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(matrix.inverse());
    return [point.x, point.y];
  };
  const all = () => { view = whole.slice(); settle(); };

  const open = (drawing) => {
    const original = drawing.querySelector("svg");
    const box = original && original.viewBox.baseVal;
    if (!box || !box.width) return;
    svg = original.cloneNode(true);
    whole = [box.x, box.y, box.width, box.height];
    stage.replaceChildren(svg);
    const title = drawing.closest("figure").querySelector("figcaption strong");
    const name = title ? title.textContent.replace(/\.$/, "") : "";
    document.getElementById("zoom-title").textContent = name;
    stage.style.aspectRatio = `${box.width} / ${box.height}`;
    all();
    dialog.showModal();
    stage.focus();
  };

  for (const drawing of document.querySelectorAll("figure .drawing")) {
    drawing.tabIndex = 0;
    drawing.setAttribute("role", "button");
    drawing.title = "enlarge";
    drawing.addEventListener("click", () => open(drawing));
    drawing.addEventListener("keydown", (event) => {
      if (event.key !== "Enter" && event.key !== " ") return;
      event.preventDefault();
      open(drawing);
    });
  }

  stage.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoom(event.deltaY < 0 ? kStep : 1 / kStep, pointOf(event));
  }, { passive: false });
  stage.addEventListener("dblclick", all);
  let last = null;
  stage.addEventListener("pointerdown", (event) => {
    last = pointOf(event);
    stage.setPointerCapture(event.pointerId);
  });
  stage.addEventListener("pointermove", (event) => {
    if (!last) return;
    const here = pointOf(event);
    view[0] += last[0] - here[0];
    view[1] += last[1] - here[1];
    settle();
    last = pointOf(event);
  });
  for (const name of ["pointerup", "pointercancel"]) {
    stage.addEventListener(name, () => { last = null; });
  }
  const actions = {
    "+": () => zoom(kStep), "=": () => zoom(kStep), "-": () => zoom(1 / kStep), "0": all,
    ArrowLeft: () => move(-0.1, 0), ArrowRight: () => move(0.1, 0),
    ArrowUp: () => move(0, -0.1), ArrowDown: () => move(0, 0.1),
  };
  dialog.addEventListener("keydown", (event) => {
    const act = actions[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  });
  const buttons = { in: () => zoom(kStep), out: () => zoom(1 / kStep), all,
                    close: () => dialog.close() };
  for (const button of dialog.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => buttons[button.dataset.zoom]());
  }
  dialog.addEventListener("click", (event) => {
    if (event.target === dialog) dialog.close();  // beside the figure
  });
  dialog.addEventListener("close", () => stage.replaceChildren());
})();
