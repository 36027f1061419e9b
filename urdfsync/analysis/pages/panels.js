"use strict";
/* Axes, tree, details and diagram: what stands beside the picture. All texts of the data are set as text, never as HTML. */

const SYMBOLS = { rotational: "⟳", translational: "↔", planar: "⬔", floating: "✥", ball: "◉", "": "─" };
const DEGREES = 180 / Math.PI;

/* Returns a new HTML element with attributes, a text or children, and listeners. */
function make(tag, attributes = {}, content = [], listeners = {}) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== null && value !== false) element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...(Array.isArray(content) ? content : [content]));
  for (const [kind, listener] of Object.entries(listeners)) element.addEventListener(kind, listener);
  return element;
}

/* Returns the name of an element without its kind: `hand` of `link hand`. */
function nameOf(element) {
  return element.slice(element.indexOf(" ") + 1);
}

function rounded(value) {
  return String(Number(value.toPrecision(5)));
}

/* Returns marks for what changed in the source, what the user edited, and what has a finding. */
function mark(data, element) {
  const words = [data.statuses[element], data.edited[element] && "edited", data.findings[element] && "finding"].filter(Boolean);
  return words.flatMap((word) => [" ", make("span", { class: `mark ${word}` }, word)]);
}

/* Fills the panel of axes. `move` is called with an element and a position, `units` has a button for each unit of angles.
   Returns a function that shows all positions. */
function fillAxes(panel, units, data, move, select) {
  const follows = (hinge) => hinge.leader ? `follows ${nameOf(hinge.leader)}` : hinge.is_dependent ? "follows through loops" : "";
  const free = data.now.hinges.filter(isFree);
  const followers = data.now.hinges.filter((hinge) => hinge.motion && follows(hinge));
  if (free.length === 0) panel.append(make("p", { class: "quiet" }, "Nothing here moves by itself."));
  const shown = new Map();
  let unit = "rad", latest = new Map();
  const scaleOf = (turns) => turns && unit === "°" ? DEGREES : 1;
  const show = (positions) => {
    latest = positions;
    for (const [name, one] of shown) one(positions.get(name));
  };
  for (const name of ["rad", "°"]) {
    units.append(make("button", { type: "button", "aria-pressed": String(name === unit), title: `Angles in ${name === "°" ? "degrees" : "radians"}` }, name, {
      click: () => {
        unit = name;
        for (const each of units.children) each.setAttribute("aria-pressed", String(each.textContent === unit));
        show(latest);
      },
    }));
  }
  const order = new Map(data.now.bodies.map((body, place) => [body.element, place]));
  free.sort((one, other) => order.get(one.child) - order.get(other.child));
  for (const [hinge, way] of [...free, ...followers].flatMap((each) => waysOf(each).map((way) => [each, way]))) {
    const { turns } = way, name = nameOf(way.name);
    const label = make("button", { type: "button", class: "name" }, [`${SYMBOLS[hinge.motion]} ${name}`, ...mark(data, hinge.element)],
      { click: () => select(hinge.element) });
    const unitShown = make("span", { class: "unit" }, "");
    if (follows(hinge)) {
      const value = make("output", {}, "");
      panel.append(make("div", { class: "axis", "data-axis": hinge.element }, make("div", { class: "top" }, [label, make("span", { class: "quiet" }, follows(hinge)), value, unitShown])));
      shown.set(way.name, (position) => {
        value.textContent = (position * scaleOf(turns)).toFixed(scaleOf(turns) === 1 ? 4 : 2);
        value.className = isBeyond(hinge, position) ? "removed" : "";
        unitShown.textContent = `${turns ? unit : "m"}${value.className && ", beyond its limit"}`;
      });
      continue;
    }
    const [low, high] = endsOfWay(hinge, way);
    const set = (text, scale) => { if (text !== "" && Number.isFinite(Number(text))) move(way.name, Number(text) / scale); };
    const slider = make("input", { type: "range", min: low, max: high, step: "any", "aria-label": `Position of ${name}` }, [], { input: () => set(slider.value, 1) });
    const number = make("input", { type: "number", step: "any" }, [], { change: () => set(number.value, scaleOf(turns)) });
    const ends = [make("span"), make("span", { class: "removed" }), make("span")];
    panel.append(make("div", { class: "axis", "data-axis": way.name }, [make("div", { class: "top" }, [label, number, unitShown]), slider, make("div", { class: "ends" }, ends)]));
    shown.set(way.name, (position) => {
      const scale = scaleOf(turns);
      slider.value = position;
      if (document.activeElement !== number) number.value = Number((position * scale).toFixed(scale === 1 ? 6 : 4));
      const shownUnit = turns ? unit : "m", isPassed = isBeyond(hinge, position);
      const other = !turns ? `${(position * 1000).toFixed(1)} mm` : scale === 1 ? `${(position * DEGREES).toFixed(1)}°` : `${position.toFixed(4)} rad`;
      unitShown.textContent = `${shownUnit} = ${other}`;
      number.setAttribute("aria-label", `Position of ${name} in ${shownUnit}`);
      number.setAttribute("aria-invalid", String(isPassed));
      const limits = [hinge.lower, hinge.upper].map((limit) => limit === null ? "no limit" : `${rounded(limit * scale)} ${shownUnit}`);
      [limits[0], isPassed ? "beyond its limit" : "", limits[1]].forEach((words, place) => { ends[place].textContent = words; });
    });
  }
  return show;
}

/* Fills the panel with the tree of links. Returns a function that marks an element in it. */
function fillTree(panel, data, select) {
  const above = new Map(data.now.hinges.map((hinge) => [hinge.child, hinge])), depth = new Map();
  const list = make("div", { role: "tree", "aria-label": "Links" }), items = new Map();
  for (const body of data.now.bodies) {
    const hinge = above.get(body.element);
    depth.set(body.element, hinge ? depth.get(hinge.parent) + 1 : 0);
    const content = [make("span", {}, nameOf(body.element)), ...mark(data, body.element)];
    if (hinge?.element) {
      content.unshift(make("span", { class: "joint" }, [`${SYMBOLS[hinge.motion]} ${nameOf(hinge.element)}`, ...mark(data, hinge.element), " › "],
        { click: (event) => { event.stopPropagation(); select(hinge.element); } }));
    }
    const item = make("div", { role: "treeitem", "aria-level": depth.get(body.element) + 1, "aria-selected": "false", tabindex: items.size ? "-1" : "0", "data-link": body.element }, content,
      { click: () => select(body.element) });
    item.style.paddingLeft = `${0.3 + 0.8 * depth.get(body.element)}rem`;
    items.set(body.element, item);
    list.append(item);
  }
  list.addEventListener("keydown", (event) => {
    const visible = [...items.values()].filter((item) => !item.hidden), place = visible.indexOf(document.activeElement);
    const next = { ArrowDown: place + 1, ArrowUp: place - 1, Home: 0, End: visible.length - 1 }[event.key];
    if (event.key === "Enter") document.activeElement.click();
    else if (next === undefined) return;
    else visible[next]?.focus();
    event.preventDefault();
    event.stopPropagation();
  });
  const filter = make("input", { id: "filter", type: "search", placeholder: "Find by name", "aria-label": "Find by name" }, [], {
    input: () => { for (const item of items.values()) item.hidden = !item.textContent.toLowerCase().includes(filter.value.toLowerCase()); },
  });
  panel.append(filter, list);
  return (element) => {
    const hinge = data.now.hinges.find((each) => each.element === element), link = hinge ? hinge.child : element;
    for (const [name, item] of items) {
      item.setAttribute("aria-selected", String(name === link));
      item.tabIndex = name === link || (!items.has(link) && item === list.firstChild) ? 0 : -1;
    }
    const item = items.get(link);
    if (item && !panel.hidden) panel.scrollTop += item.getBoundingClientRect().top - panel.getBoundingClientRect().top - panel.clientHeight / 2;
  };
}

/* Returns the two bodies of a hinge or a loop. */
function endsOf(item) {
  return item.ends ? item.ends.map((end) => end.body) : [item.parent, item.child];
}

/* Shows the numbers, neighbours, changes and files of an element; a hint if there is none. */
function fillDetails(panel, data, element, select) {
  const { bodies, hinges, loops } = data.now, old = data.before || { bodies: [], hinges: [], loops: [] };
  const find = (scene) => [...scene.bodies, ...scene.hinges, ...scene.loops].find((each) => each.element === element);
  const item = element && (find(data.now) || find(old));
  if (!item) {
    panel.replaceChildren(make("p", { class: "quiet" }, `Click a part to see its numbers, changes and files.${hinges.some((each) => each.motion) ? " Drag it to move its joint." : ""}`));
    return;
  }
  const link = (name) => make("button", { type: "button", class: "name" }, name, { click: () => select(name) });
  const parts = [make("h3", {}, [element, ...mark(data, element)])], edits = data.edited[element] || [];
  const changes = data.changes[element] || [];
  const findings = data.findings[element] || [];
  if (findings.length) parts.push(make("ul", {}, findings.map((words) => make("li", { class: "finding" }, words))));
  if (changes.length) parts.push(make("ul", {}, changes.map((words) => make("li", { class: "changed" }, words))));
  if (edits.length) parts.push(make("ul", {}, edits.map(([, words]) => make("li", { class: "edited" }, `your edit: ${words}`))));
  const facts = item.facts.flatMap(([label, value]) => { // those of the source; the user's beside them
    const mine = edits.find(([edited]) => edited === label)?.[2];
    return [make("dt", {}, label), make("dd", {}, [value, ...(mine ? [" ", make("span", { class: "mark edited" }, `yours: ${mine}`)] : [])])];
  });
  const around = item.shapes
    ? [...hinges, ...loops].filter((each) => endsOf(each).includes(element)).map((each) => each.element).filter(Boolean)
    : endsOf(item).filter((name) => bodies.some((body) => body.element === name));
  parts.push(make("dl", {}, facts));
  if (around.length) parts.push(make("p", {}, [make("span", { class: "quiet" }, "beside it: "), ...around.flatMap((name, place) => [place ? ", " : "", link(name)])]));
  const files = data.files[element] || [];
  if (files.length) parts.push(make("p", { class: "quiet" }, "files"), make("ul", {}, files.map((file) => make("li", {}, make("code", {}, file)))));
  panel.replaceChildren(...parts);
  panel.scrollTop = 0;
}

/* Draws the diagram, if there is one. Returns a function that marks an element in it. */
function drawDiagram(place, data, select) {
  if (!place || !data.diagram) return () => {};
  const drawn = new DOMParser().parseFromString(data.diagram, "image/svg+xml").documentElement;
  const shadow = place.attachShadow({ mode: "open" }); // keeps the diagram's styles from the page
  const svg = document.importNode(drawn, true);
  shadow.append(svg);
  const natural = Number(svg.getAttribute("width"));
  const fit = (isWhole) => { // a wide robot is scrolled: its texts would be too small
    svg.style.width = isWhole ? "100%" : "";
    svg.style.height = isWhole ? "auto" : "";
  };
  const isNarrow = () => natural < 2 * place.clientWidth;
  fit(isNarrow());
  addEventListener("beforeprint", () => fit(true));
  addEventListener("afterprint", () => fit(isNarrow()));
  const icons = new Map(), components = new Map([...data.now.bodies, ...data.now.hinges, ...data.now.loops].map((each) => [each.component, each.element]));
  for (const title of svg.querySelectorAll("g > title")) {
    const element = components.get(title.textContent);
    if (!element) continue;
    const group = title.parentNode, icon = group.querySelector("g");
    icons.set(element, icon);
    group.style.cursor = "pointer";
    group.addEventListener("click", () => select(element));
    if (data.statuses[element]) icon.append(frame(data.statuses[element] === "added" ? "#157f3d" : "#d97706", 1.2));
  }
  let marked = null;
  return (element) => {
    marked?.remove();
    const icon = icons.get(element);
    if (!icon) return;
    marked = frame("#c2188b", 2.4);
    marked.setAttribute("data-selected", element);
    icon.append(marked);
    const box = icon.getBoundingClientRect(), window_ = place.getBoundingClientRect();
    place.scrollLeft += box.left - window_.left - place.clientWidth / 2;
    place.scrollTop += box.top - window_.top - place.clientHeight / 2;
  };
}

/* Returns a frame around an icon of the diagram, which is 20 units wide. */
function frame(color, width) {
  const rectangle = document.createElementNS("http://www.w3.org/2000/svg", "rect");
  const attributes = { x: -12, y: -12, width: 24, height: 24, rx: 4, fill: "none", stroke: color, "stroke-width": width };
  for (const [name, value] of Object.entries(attributes)) rectangle.setAttribute(name, value);
  return rectangle;
}
