// A run in progress: its record comes piece by piece, from the program that runs it (fram run --live) or from the page
// around this one (the simulator in the browser), and the player grows with it.
import { RecordReader } from './record.js';

const PERIOD = 250; // between two questions [ms]
const PATIENCE = 3; // answers that may fail one after the other

/** @param address where the record is asked for; '': the page around this one calls window.framAppend(bytes) with each
 *  piece and window.framEnd() after the last.
 *  @param begin begin(record) makes the player when the first frame is there. @param tell tell(text) shows a line. */
export function follow(address, begin, tell) {
    const reader = new RecordReader();
    let player = null, seen = 0, explained = false, told = false;
    // The first thing that goes wrong is why the others do.
    const say = (text) => { if (!told) { told = true; tell(text); } };
    const append = (bytes) => {
        reader.append(bytes);
        const { frames, loads } = reader.record;
        if (loads && player && !explained) {
            explained = true;
            player.explain();
        }
        if (frames.length === seen) return;
        seen = frames.length;
        if (player) player.grow();
        else player = begin(reader.record);
    };
    window.framEnd = () => { window.framEnded = true; if (!player) say('The run left no frames.'); };
    window.framAppend = append;
    if (address) ask(address, append, say);
}

/** Asks for what follows the bytes that are here, until the run has ended. */
async function ask(address, append, tell) {
    let have = 0, failed = 0;
    for (let last = false; !last;) {
        let bytes = null;
        try {
            const answer = await fetch(`${address}?from=${have}`, { cache: 'no-store' });
            if (!answer.ok) throw new Error(`${answer.status}`);
            bytes = await answer.arrayBuffer();
            last = answer.headers.get('Fram-Run') === 'ended';
            failed = 0;
        } catch (e) {
            if (++failed === PATIENCE) { tell('The run has ended, or does not answer.'); break; }
        }
        try {
            have += bytes?.byteLength ?? 0;
            if (bytes?.byteLength) append(bytes);
        } catch (e) {
            tell(`The record cannot be played: ${e.message}`);
            break;
        }
        await new Promise((done) => { setTimeout(done, PERIOD); });
    }
    window.framEnd();
}
