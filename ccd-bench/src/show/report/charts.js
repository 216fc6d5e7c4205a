// The plane of time and error of one scene, with a strip for unsafe methods.
"use strict";
(() => {
  const measured = JSON.parse(document.getElementById("measured").textContent);
  const plot = document.getElementById("plane-plot");
  const select = document.getElementById("plane-scene");
  const LEAST_ERROR = 1e-12;
  const NARROW = 760;
  const DASHES = { ours: "solid", rival: "dash", peer: "dot", model: "dashdot" };
  const HOVER = "<b>%{customdata[0]}</b><br>tolerance %{customdata[1]}<br>"
    + "median %{customdata[2]:.4~g} µs, mean %{customdata[3]:.4~g} µs<br>"
    + "mean error %{customdata[4]}<br>late %{customdata[5]}, missed %{customdata[6]}, "
    + "false %{customdata[7]}, unresolved %{customdata[8]} of %{customdata[9]}<extra></extra>";

  function trace(method, cells) {
    const error = (cell) => (cell.error === null ? "none: nothing found" : cell.error.toExponential(1));
    const points = method.unsafe ? cells : cells.filter((cell) => cell.error !== null);
    return {
      type: "scatter",
      name: method.unsafe ? `${method.label} (unsafe)` : method.label,
      mode: method.unsafe ? "markers" : "lines+markers",
      x: points.map((cell) => (method.unsafe ? method.label : Math.max(cell.error, LEAST_ERROR))),
      y: points.map((cell) => cell.median_us),
      xaxis: method.unsafe ? "x2" : "x",
      legendgroup: method.group,
      legendgrouptitle: { text: method.group },
      customdata: points.map((cell) => [method.name, cell.tolerance.toExponential(0), cell.median_us,
        cell.mean_us, error(cell), cell.late, cell.missed, cell.false, cell.unresolved, cell.rows]),
      hovertemplate: HOVER,
      line: { color: method.colour, dash: DASHES[method.family], width: 2 },
      marker: { color: method.colour, size: 9, symbol: method.unsafe ? "circle-open" : "circle" },
    };
  }

  function draw() {
    const scene = select.value;
    const traces = [];
    for (const method of measured.methods) {
      const cells = measured.cells.filter((cell) => cell.scene === scene && cell.method === method.name);
      if (cells.length > 0) traces.push(trace(method, cells));
    }
    const strip = traces.some((one) => one.xaxis === "x2");
    const power = { type: "log", exponentformat: "power", dtick: 1, gridcolor: "#e4e4e4" };
    const layout = {
      margin: { l: 70, r: 10, t: 36, b: 60 },
      // Below the plot where there is no room beside it.
      legend: { groupclick: "toggleitem", ...(plot.clientWidth < NARROW ? { orientation: "h", y: -0.25 } : { orientation: "v" }) },
      uirevision: "kept",
      xaxis: { ...power, domain: strip ? [0, 0.74] : [0, 1], dtick: 2, title: { text: "mean error of the time of contact, share of duration" } },
      yaxis: { ...power, title: { text: "time of a query, median, µs" } },
    };
    if (strip) layout.xaxis2 = { domain: [0.77, 1], type: "category", showticklabels: false, title: { text: "unsafe" } };
    return Plotly.react(plot, traces, layout, { responsive: true, displaylogo: false });
  }

  for (const scene of measured.scenes) select.add(new Option(scene));
  select.addEventListener("change", draw);
  if (measured.scenes.length > 0) draw().then(() => { document.documentElement.dataset.plane = "drawn"; });
  else document.documentElement.dataset.plane = "empty";
})();
