/* Inside the report's verdict: what its files share.  One module with report_verdict. */
#ifndef RESULTS_REPORT_VERDICT_PARTS_H
#define RESULTS_REPORT_VERDICT_PARTS_H

#include "results/report_parts.h"

/* A text holds the longest message of a failed run (run_note), and what goes before it. */
enum { VERDICT_TEXT_SIZE = sizeof((run_note *)0)->message + 128 };

typedef struct finding {
    verdict_grade grade;
    char text[VERDICT_TEXT_SIZE], remedy[VERDICT_TEXT_SIZE];
} finding;

typedef struct verdict {
    report *r;
    ARRAY(finding) findings;
    bool failed;     /* no memory for one */
    bool kept, lost; /* a limit of station is set: every vessel stayed within, or one did not, */
    bool unsure;     /* or may not have */
    int32_t lines, parted;
    char load[128]; /* of a single vessel */
} verdict;

/* Adds one: a text, which begins with a capital whatever it begins with here, and what to do about it, or "". */
void verdict_find(verdict *v, verdict_grade grade, const char *remedy, const char *format, ...)
    __attribute__((format(printf, 4, 5)));
/* "vessel tanker: " before what is said of one of several. */
const char *verdict_whose(const report *r, char out[48]);
/* Of a force that is told: "278 kN". */
enum { VERDICT_DIGITS = VALUE_DIGITS };

/* How the vessel that is reported kept its station. */
void verdict_station(verdict *v);

#endif
