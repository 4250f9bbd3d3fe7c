// Draws the plots with Chart.js in the page's colours, then looks whether everything is there.
// SPDX-License-Identifier: GPL-3.0-or-later
"use strict";
(() => {
  const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const dashes = [[], [9, 4], [2, 3], [12, 4, 2, 4], [5, 5], []];
  const marks = ["circle", "rectRot", "triangle", "rect", "crossRot", "star"];
  const round = x => Number(x.toPrecision(4)).toString();

  // Of a series that says its style: marks alone, a line alone, or the edge of a band that is filled down to the last such edge.
  const styles = {
    marks: () => ({showLine: false, pointRadius: 2, order: 2}),
    line: () => ({pointRadius: 0, order: 1}),
    band: series => ({pointRadius: 0, borderWidth: 0, fill: Boolean(series.name), backgroundColor: "rgba(120, 130, 145, 0.22)", order: 3}),
  };

  const lines = plot => ({
    type: "scatter",
    data: {
      datasets: plot.series.map((series, i) => {
        const dataset = {
          label: series.name, data: series.points.map(p => ({x: p[0], y: p[1], more: p[2]})), showLine: true,
          borderColor: colour(`--series-${i % 6 + 1}`), backgroundColor: colour(`--series-${i % 6 + 1}`), borderDash: dashes[i % 6],
          pointStyle: marks[i % 6], pointRadius: series.points.length > 60 ? 0 : 2.5, pointHoverRadius: 6, borderWidth: 2,
          ...(series.style ? {borderDash: [], pointStyle: "circle", ...styles[series.style](series)} : {}),
        };
        if (dataset.fill) dataset.fill = plot.series.length - 1;
        return dataset;
      }),
    },
    tooltip: {
      title: items => items[0].dataset.label,
      label: item => [`${plot.x}: ${round(item.raw.x)}`, `${plot.y}: ${round(item.raw.y)}`]
        .concat(item.raw.more === undefined ? [] : [`${plot.more}: ${round(item.raw.more)}`]),
    },
  });

  const bars = plot => ({
    type: "bar",
    data: {
      labels: plot.labels,
      datasets: [{label: plot.y, data: plot.counts, backgroundColor: colour("--series-1"), barPercentage: 1, categoryPercentage: .94}],
    },
    tooltip: {title: items => `${plot.x}: ${items[0].label}`, label: item => `${plot.y}: ${item.raw}`},
  });

  const draw = canvas => {
    const plot = JSON.parse(document.getElementById(canvas.dataset.plot).textContent);
    const parts = (plot.kind === "lines" ? lines : bars)(plot);
    const axis = (title, range) => ({
      title: {display: true, text: title, color: colour("--soft")}, beginAtZero: true, min: range?.[0], max: range?.[1],
      grid: {color: colour("--line")}, ticks: {color: colour("--soft"), maxRotation: 0, autoSkip: true},
    });
    const font = getComputedStyle(document.body).fontFamily;
    return new Chart(canvas, {
      type: parts.type, data: parts.data,
      options: {
        animation: false, responsive: true, maintainAspectRatio: false, font: {family: font, size: 13},
        interaction: {mode: "nearest", axis: plot.kind === "lines" ? "xy" : "x", intersect: false},
        scales: {x: axis(plot.x, plot.x_range), y: axis(plot.y, plot.y_range)},
        plugins: {
          legend: {display: plot.kind === "lines", labels: {color: colour("--ink"), usePointStyle: true, boxHeight: 8, filter: item => item.text !== ""}},
          tooltip: {callbacks: parts.tooltip, displayColors: false},
        },
      },
    });
  };

  let charts = [];
  const drawAll = () => {
    for (const chart of charts) chart.destroy();
    charts = [...document.querySelectorAll("canvas[data-plot]")].map(draw);
  };

  // True when something in a series' colour is inside the axes.
  const hasCurve = chart => {
    const scale = chart.currentDevicePixelRatio, area = chart.chartArea;
    const pixels = chart.ctx.getImageData(area.left * scale, area.top * scale, area.width * scale, area.height * scale).data;
    const wanted = chart.data.datasets.map(d => d.backgroundColor.match(/[0-9a-f]{2}/gi).map(x => parseInt(x, 16)));
    let count = 0;
    for (let i = 0; i < pixels.length; i += 4)
      if (pixels[i + 3] > 200 && wanted.some(c => c.every((x, k) => Math.abs(x - pixels[i + k]) < 16))) ++count;
    return count > 50;
  };

  // What the page finds of itself: data-self-check on <html>, read by tests.
  const selfCheck = () => {
    const pictures = [...document.images], plots = [...document.querySelectorAll("canvas[data-plot]")];
    const found = {
      pictures: pictures.length, pictures_drawn: pictures.filter(p => p.complete && p.naturalWidth > 0).length,
      plots: plots.length, plots_drawn: charts.filter(hasCurve).length, errors: window.pageErrors,
    };
    found.well = found.pictures === found.pictures_drawn && found.plots === found.plots_drawn && found.errors.length === 0;
    document.documentElement.dataset.selfCheck = JSON.stringify(found);
  };

  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", drawAll);
  addEventListener("beforeprint", drawAll);
  addEventListener("afterprint", drawAll);
  addEventListener("load", () => {
    try { drawAll(); } catch (error) { window.pageErrors.push(String(error)); console.error(error); }
    selfCheck();
  });
})();
