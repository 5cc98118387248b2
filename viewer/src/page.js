// What all parts of the page share: its elements by their names, and the line in which it says something.

export const $ = (id) => document.getElementById(id);

export function tell(text) { $('note').textContent = text; }
/** For a few seconds. */
export function note(text) { tell(text); setTimeout(() => { $('note').textContent = ''; }, 6000); }
