#include "results/track_results.h"

#include <stdio.h>

bool track_was_kept(const run_track *t) { return t->time > 0 && t->largest <= t->limit; }

void track_text(const run_track *t, char *out, size_t size)
{
    const char *who = t->vessel[0] ? "Vessel " : "The vessel";
    if (!(t->time > 0)) {
        snprintf(out, size, "%s%s did not come to its track after the transient.", who, t->vessel);
        return;
    }
    snprintf(out, size, "%s%s %s its track: %.3g m off at most, %.3g m r.m.s., over %.4g s; %.0f round%s.", who,
             t->vessel, track_was_kept(t) ? "kept" : "did not keep", t->largest, t->rms, t->time, t->rounds,
             t->rounds == 1 ? "" : "s");
}

const char *track_remedy(const run_track *t)
{
    return track_was_kept(t) ? ""
                             : "Loads behind it are not those of the pattern that was asked for: give it wider turns, "
                               "less speed, or a ship that turns better; in ice one turns less than in open water.";
}

void track_table(html_page *page, const run_note *note)
{
    static const char *const heads[] = {"vessel",    "largest track error [m]", "r.m.s. [m]",
                                        "limit [m]", "time that counts [s]",    "rounds"};
    if (note->tracks.count == 0)
        return;
    html_section(page, "Tracks that were sailed");
    html_paragraph(
        page,
        "Distance across the track after the transient, from when a ship first is within half its length of "
        "it and heads along it; corners and loops, which are there to turn about, do not count, but for a "
        "square, or way points, of corners with hardly anything straight between them. The column track_error has "
        "it over time.");
    html_table_begin(page, heads, 6);
    for (int32_t i = 0; i < note->tracks.count; i++) {
        const run_track *t = &note->tracks.data[i];
        bool known = t->time > 0;
        html_row_begin(page);
        html_row_name(page, t->vessel[0] ? t->vessel : "vessel");
        html_number(page, known ? t->largest : (double)NAN);
        html_number(page, known ? t->rms : (double)NAN);
        html_number(page, t->limit);
        html_number(page, t->time);
        html_number(page, t->rounds);
        html_row_end(page);
    }
    html_table_end(page);
}
