// Opens a cell of a map: its steps, the command that repeats them, and the scene.
"use strict";
(() => {
  const details = JSON.parse(document.getElementById("details").textContent);
  const element = (id) => document.getElementById(id);
  const [scenes, shots] = ["view-scene", "view-shot"].map(element);
  let shown = null;

  function cell(text, isNumber) {
    const made = document.createElement("td");
    made.textContent = text;
    if (isNumber) made.className = "number";
    return made;
  }

  function line(step) {
    const row = document.createElement("tr");
    row.append(cell(step.value, true), cell(step.verdict), cell(step.exact), cell(step.given), cell(step.cost, true));
    return row;
  }

  function choose(list, index) {
    list.selectedIndex = index;
    list.dispatchEvent(new Event("change"));
  }

  function place(button) {
    return button.dataset.cell.split(",").map(Number);
  }

  function detailOf(button) {
    const [family, method] = place(button);
    return details[family][method];
  }

  function open(button) {
    const detail = detailOf(button);
    shown?.removeAttribute("aria-pressed");
    button.setAttribute("aria-pressed", "true");
    shown = button;
    element("cell-name").textContent = button.closest("tr").querySelector("th").firstChild.textContent
      + ": " + button.closest("table").tHead.rows[0].cells[place(button)[1] + 1].textContent;
    element("cell-command").textContent = detail.command;
    element("cell-steps").replaceChildren(...detail.steps.map(line));
    element("cell-missing").hidden = detail.view !== null;
    element("cell-view").hidden = detail.view === null;
    if (detail.view !== null) {
      const [view, shot] = detail.view;
      if (scenes.selectedIndex !== view) choose(scenes, view);
      choose(shots, shot);
    }
  }

  const buttons = [...document.querySelectorAll("[data-cell]")];
  for (const button of buttons) {
    button.addEventListener("click", () => { open(button); element("cell").scrollIntoView(); });
  }
  element("cell-copy").addEventListener("click", () => navigator.clipboard?.writeText(element("cell-command").textContent));
  // A contact that was passed is open from the start, if there is a picture of one.
  const pictures = buttons.filter((button) => detailOf(button).view !== null);
  const isPassed = (step) => step.verdict === "late" || step.verdict === "missed";
  const first = pictures.find((button) => detailOf(button).steps.some(isPassed)) ?? pictures[0] ?? buttons[0];
  if (first) open(first);
  document.documentElement.dataset.map = buttons.length > 0 ? "drawn" : "empty";
})();
