// Sorts tables by the column whose name is clicked.
"use strict";
(() => {
  const collator = new Intl.Collator("en", { numeric: true });

  // Numbers are sorted by value, despite other characters around them; words follow, in alphabetical order.
  function compare(a, b) {
    const [x, y] = [a, b].map((text) => parseFloat(text.replace(/[,>\s]/g, "")));
    if (Number.isNaN(x) && Number.isNaN(y)) return collator.compare(a, b);
    if (Number.isNaN(x)) return 1;
    if (Number.isNaN(y)) return -1;
    return x - y;
  }

  function sort(table, column, header) {
    const sign = header.getAttribute("aria-sort") === "ascending" ? -1 : 1;
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", sign > 0 ? "ascending" : "descending");
    const rows = [...table.tBodies[0].rows];
    const text = (row) => row.cells[column]?.textContent ?? "";
    rows.sort((a, b) => sign * compare(text(a), text(b)));
    table.tBodies[0].append(...rows);
  }

  for (const table of document.querySelectorAll("#tables table")) {
    [...table.tHead.rows[0].cells].forEach((header, column) => {
      header.querySelector("button").addEventListener("click", () => sort(table, column, header));
    });
  }
})();
