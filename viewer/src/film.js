// Pictures and videos of the view as it stands, which the browser saves as files.
import { drawHeader } from './legend.js';
import { $, note } from './page.js';

export class Film {
    /** view(): what the legend shows of the camera. */
    constructor(canvas, legend, view) {
        this.canvas = canvas;
        this.legend = legend;
        this.view = view;
        this.recorder = null; // while a video is recorded
    }

    /** The picture as it stands with title, time and legend drawn into it. */
    compose(out) {
        const from = this.canvas, ratio = from.width / from.clientWidth, g = out.getContext('2d');
        if (out.width !== from.width || out.height !== from.height) {
            out.width = from.width; out.height = from.height;
        }
        g.setTransform(1, 0, 0, 1, 0, 0);
        g.drawImage(from, 0, 0);
        g.setTransform(ratio, 0, 0, ratio, 12 * ratio, 12 * ratio);
        const beside = from.width / ratio - this.legend.width - 12; // where the legend begins
        drawHeader(g, $('title').textContent, [$('clock').textContent, $('load').textContent], beside - 24);
        g.setTransform(ratio, 0, 0, ratio, beside * ratio, 12 * ratio);
        this.legend.draw(g, this.view());
        return out;
    }

    still(name) {
        return new Promise((done) => {
            this.compose(document.createElement('canvas')).toBlob((blob) => {
                download(blob, name);
                done(blob);
            });
        });
    }

    /** Records what add() is told of until stop(); play() is called as it begins.  A second click ends it. */
    click(play) {
        if (this.recorder) { this.recorder.stop(); return this.filmed; }
        const type = ['video/webm;codecs=vp9', 'video/webm;codecs=vp8', 'video/mp4']
            .find((t) => window.MediaRecorder?.isTypeSupported(t));
        if (!type) { note('This browser cannot record video; fram video makes one.'); return Promise.resolve(null); }
        const parts = [];
        this.filmCanvas = this.compose(document.createElement('canvas'));
        const stream = this.filmCanvas.captureStream(25);
        this.recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 8e6 });
        this.recorder.ondataavailable = (e) => parts.push(e.data);
        this.filmed = new Promise((done) => {
            this.recorder.onstop = () => {
                const blob = new Blob(parts, { type });
                this.recorder = null;
                $('film').textContent = 'video';
                download(blob, `fram.${type.includes('mp4') ? 'mp4' : 'webm'}`);
                done(blob);
            };
        });
        this.recorder.start(500);
        $('film').textContent = 'stop';
        play();
        return this.filmed;
    }

    /** The view was drawn anew. */
    add() { if (this.recorder) this.compose(this.filmCanvas); }

    stop() { if (this.recorder) this.recorder.stop(); }
}

function download(blob, name) {
    const link = document.createElement('a');
    link.href = URL.createObjectURL(blob);
    link.download = name;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}
