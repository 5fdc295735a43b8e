// Elements, numbers and times as people read them.

const byId = (id) => document.getElementById(id);

/** Make an element; `on…` values are listeners, the others attributes; texts are never HTML. */
function make(tag, attributes = {}, ...children) {
  return dress(document.createElement(tag), attributes, children);
}

function makeSvg(tag, attributes = {}, ...children) {
  return dress(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

function dress(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.filter((child) => child !== null));
  return element;
}

/** Write text only where it changed, so that a frame costs nothing when nothing happens. */
function say(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/** 131.27 -> "2:11.3" */
function clockText(seconds, decimals = 1) {
  const whole = Math.round(seconds * 10 ** decimals) / 10 ** decimals;
  const minutes = Math.floor(whole / 60);
  const rest = (whole - 60 * minutes).toFixed(decimals);
  return `${minutes}:${rest.padStart(decimals ? 3 + decimals : 2, "0")}`;
}

const fixed = (value, decimals = 1) =>
  value.toLocaleString("en", {
    minimumFractionDigits: decimals, maximumFractionDigits: decimals, useGrouping: true,
  }).replaceAll(",", "\u2009");

const percent = (share, decimals = 1) => `${(100 * share).toFixed(decimals)}\u202f%`;

/** Cut the middle out of a long name: its ends tell names apart. */
const shorten = (name, letters) => (name.length <= letters ? name
  : `${name.slice(0, Math.floor((letters - 1) / 2))}\u2026${name.slice(-Math.ceil((letters - 1) / 2))}`);

const clamp = (value, low, high) => Math.min(Math.max(value, low), high);
