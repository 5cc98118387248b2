// Texts that are drawn into a room: in several lines, or cut.  Knows no more than how wide a text is.

/** Words in lines no wider than room(number of the line) [px]. */
export function wrapped(g, text, room) {
    const lines = [''];
    for (const word of text.split(' ')) {
        const last = lines.length - 1, longer = lines[last] ? `${lines[last]} ${word}` : word;
        if (lines[last] && g.measureText(longer).width > room(last)) lines.push(word);
        else lines[last] = longer;
    }
    return lines;
}

/** As much of a text as fits, with an ellipsis for the rest. */
export function shortened(g, text, room) {
    if (g.measureText(text).width <= room) return text;
    const letters = [...text];
    let [fits, beyond] = [0, letters.length];
    while (beyond - fits > 1) {
        const middle = (fits + beyond) >> 1;
        if (g.measureText(`${letters.slice(0, middle).join('')}\u2026`).width <= room) fits = middle;
        else beyond = middle;
    }
    return `${letters.slice(0, fits).join('').trimEnd()}\u2026`;
}
