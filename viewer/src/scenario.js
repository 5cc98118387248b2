// Reads the scenario that stands in a record: Fram's own print of it, every key on a line of its own, two blanks a
// level, items of lists after "- ".  No reader of YAML: what users write is read by the program.

const read = new WeakMap(); // of records, whose scenario never changes

/** The scenario of a record, which is read once. */
export function scenarioOf(record) {
    if (!read.has(record)) read.set(record, readScenario(record.scenario));
    return read.get(record);
}

/** @returns the scenario as objects, arrays, numbers, true, false and texts ("auto" too). */
function readScenario(text) {
    const root = {}, open = [{ at: 0, into: root, key: '' }];
    for (const line of text.split('\n')) {
        const found = line.match(/^( *)(- )?(\w+):(?: (.*))?$/);
        if (!found) continue;
        const [, indent, dash, key, value] = found, at = indent.length + (dash ? 2 : 0);
        while (open.at(-1).at > (dash ? at - 1 : at)) open.pop();
        const { into, key: parent, at: level } = open.at(-1);
        if (level < at) {
            const made = {};
            if (dash) (into[parent] ??= []).push(made);
            else into[parent] = made;
            open.push({ at, into: made });
        }
        open.at(-1).key = key;
        if (value !== undefined) open.at(-1).into[key] = valueOf(value);
    }
    return root;
}

/** Those that take part in the run, in the order of their hulls in the record. */
export function vesselsOf(scenario) {
    return (scenario.vessels ?? [scenario.vessel]).filter((v) => v && v.present !== false);
}

/** What is as large as 1 m, 1 m/s and 1 N at full size, in the size of a scenario (Froude): `run.scale` is 30 at full
 *  size, 1 in a tank. */
export function sizesOf(scenario) {
    const length = (scenario.run?.scale ?? 30) / 30;
    return { length, speed: Math.sqrt(length), force: length ** 3 };
}

function valueOf(text) {
    if (text.startsWith('"')) return JSON.parse(text);
    if (text === '[]') return [];
    if (text === 'true' || text === 'false') return text === 'true';
    return text.trim() === '' || Number.isNaN(Number(text)) ? text : Number(text);
}
