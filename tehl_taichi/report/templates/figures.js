"use strict";
(() => {
  const PAPER = 660; // px, width of a printed page between its margins
  const LOW = 380, LOWER = 290, LOWEST = 240; // px, heights of the figures of the answer on paper: alone, side by side, and in
                                              // three rows
  const SHEET = 1200, CAPTION = 75; // px, height that rows share, beside the answer on two printed pages; of a row without its
                                    // figure
  const touch = matchMedia("(pointer: coarse)").matches; // there a finger on a figure scrolls the page
  const BUTTONS = [["toImage"], ["zoom2d", "pan2d", "zoomIn2d", "zoomOut2d", "resetScale2d"]]; // none that sends data anywhere
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const plots = () => [...document.querySelectorAll(".plot")];

  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  const unpacked = async id => {
    const packed = new Blob([bytes(document.getElementById(id).textContent)]);
    return new Response(packed.stream().pipeThrough(new DecompressionStream("gzip"))).text();
  };

  /* colours of the page, in every figure */
  const template = () => {
    const style = getComputedStyle(document.documentElement);
    const [ink, faint, rule] = ["--ink", "--faint", "--rule"].map(name => style.getPropertyValue(name).trim());
    const axis = {gridcolor: rule, linecolor: faint, tickcolor: faint, zerolinecolor: rule, automargin: true};
    return {layout: {
      paper_bgcolor: "rgba(0,0,0,0)", plot_bgcolor: "rgba(0,0,0,0)", xaxis: axis, yaxis: axis,
      font: {color: ink, size: 12, family: getComputedStyle(document.body).fontFamily}, legend: {bgcolor: "rgba(0,0,0,0)"},
      modebar: {bgcolor: "rgba(0,0,0,0)", color: faint, activecolor: ink},
    }};
  };

  const draw = (place, spec) => Plotly.newPlot(place, spec.data, {...spec.layout, template: template(),
    dragmode: touch ? false : "zoom"}, {displaylogo: false, responsive: true, displayModeBar: true,
    modeBarButtons: BUTTONS});

  const repaint = size => Promise.all(plots().map(place => Plotly.relayout(place, {template: template(), ...size(place)})));

  /* rows of a table of single precision: one for each moment */
  const rows = table => {
    const values = new Float32Array(bytes(table.bdata).buffer), width = Number(table.shape.split(",")[1]);
    return n => values.subarray(n * width, (n + 1) * width);
  };

  /* the slider of a passage: the lines of each moment, and where the feature is */
  const slide = (box, spec) => {
    const place = document.querySelector(`[data-figure="${box.dataset.slides}"]`), input = box.querySelector("input");
    const lines = spec.slides.lines.map(rows), traces = spec.slides.traces, output = box.querySelector("output");
    const show = () => {
      const n = Number(input.value);
      output.value = spec.slides.labels[n];
      const at = spec.slides.at[n];
      const shapes = at === null ? [] : [{type: "line", xref: "x", yref: "paper", x0: at, x1: at, y0: 0, y1: 1,
        line: {color: "#888888", width: 1, dash: "dot"}}];
      return Plotly.update(place, {y: lines.map(row => row(n))}, {shapes}, traces);
    };
    let timer = 0;
    const play = box.querySelector("button");
    const stop = () => { clearInterval(timer); timer = 0; play.textContent = "play"; };
    play.onclick = () => {
      if (timer) return stop();
      play.textContent = "stop";
      timer = setInterval(() => { input.value = (Number(input.value) + 1) % (Number(input.max) + 1); show(); }, 80);
    };
    input.addEventListener("input", () => { stop(); show(); });
    return show();
  };

  /* on paper: light colours, figures as wide as their column of it, and those of the answer low enough for one page */
  const toPaper = () => {
    document.documentElement.classList.add("print");
    repaint(place => {
      const row = place.closest(".row"), many = row ? row.children.length : 1, front = place.closest(".front");
      const three = front && row && row.classList.contains("three");
      const width = many === 1 ? PAPER : three ? PAPER / 3 - 11 : PAPER / 2 - 8;
      if (!front) return {width};
      const share = SHEET / front.querySelectorAll(".row").length - CAPTION;
      const height = Math.min(place.offsetHeight, many === 1 ? LOW : many > 6 ? LOWEST : LOWER, share);
      place.dataset.height = place.dataset.height || place.style.height;
      place.style.height = `${height}px`;
      return {width, height, "font.size": three ? 9 : 12};
    });
  };
  const toScreen = () => {
    document.documentElement.classList.remove("print");
    repaint(place => {
      place.style.height = place.dataset.height || place.style.height;
      return {autosize: true, width: null, height: null, "font.size": 12};
    });
  };

  /* figures as wide as their place, whenever that changes: also before the next picture of the page */
  const fit = new ResizeObserver(seen => {
    if (document.documentElement.classList.contains("print")) return;
    for (const {target} of seen) {
      const drawn = target.querySelector(".main-svg");
      if (drawn && Math.abs(drawn.getBoundingClientRect().width - target.clientWidth) > 1)
        Plotly.relayout(target, {autosize: true});
    }
  });

  const start = async () => {
    const code = document.createElement("script");
    code.textContent = await unpacked("library");
    document.head.append(code);
    const specs = JSON.parse(await unpacked("figures"));
    for (const place of plots()) await draw(place, specs[place.dataset.figure]);
    for (const place of plots()) fit.observe(place);
    for (const box of document.querySelectorAll("[data-slides]")) await slide(box, specs[box.dataset.slides]);
    dark.addEventListener("change", () => repaint(() => ({})));
    addEventListener("beforeprint", toPaper);
    addEventListener("afterprint", toScreen);
    document.documentElement.dataset.ready = "yes";
  };

  /* an open document in the page: the page counts as loading until its figures are drawn, so that a browser without a screen
     does not print it before */
  const wait = () => {
    const held = document.createElement("iframe");
    held.hidden = true;
    document.body.append(held);
    held.contentDocument.open();
    return () => { held.contentDocument.close(); held.remove(); };
  };

  const loaded = wait();
  start().finally(loaded).catch(error => {
    const why = window.DecompressionStream ? String(error) : "this browser is older than 2023";
    for (const place of plots()) place.textContent = `The figure cannot be drawn: ${why}.`;
    throw error;
  });
})();
