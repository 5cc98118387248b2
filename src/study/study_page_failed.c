/* Runs that failed, with their reasons, on the page of a study. */
#include "study/study_page_parts.h"

#include <stdio.h>

/* A study that fails throughout does so for few reasons. */
enum { FAILED_MOST = 20 };

int32_t page_failed_of(const study_page *p, int32_t condition)
{
    int32_t failed = 0;
    for (int32_t i = 0; i < p->conditions[condition].rows.count; i++)
        failed += p->conditions[condition].rows.data[i].failed;
    return failed;
}

static void add_run(study_page *p, int32_t condition, int32_t index)
{
    char text[32];
    html_row_begin(&p->page);
    snprintf(text, sizeof text, "%d", (int)condition + 1);
    html_cell(&p->page, text);
    snprintf(text, sizeof text, "%lld", (long long)p->f->s->seeds.first + index);
    html_cell(&p->page, text);
    html_cell(&p->page, p->conditions[condition].rows.data[index].reason);
    html_row_end(&p->page);
}

void page_add_failed(study_page *p)
{
    static const char *const heads[] = {"condition", "seed", "reason"};
    int64_t runs, failed, shown = 0;
    page_count_runs(p, &runs, &failed);
    if (failed == 0)
        return;
    html_section(&p->page, "Failed runs");
    html_paragraph(&p->page,
                   "Means are over the other runs of a condition. Folder and log of a failed run stay, in runs/; "
                   "--retry makes it again.");
    html_table_begin(&p->page, heads, 3);
    for (int32_t c = 0; c < p->f->s->conditions && shown < FAILED_MOST; c++) {
        for (int32_t i = 0; i < p->conditions[c].rows.count && shown < FAILED_MOST; i++) {
            if (!p->conditions[c].rows.data[i].failed)
                continue;
            add_run(p, c, i);
            shown++;
        }
    }
    html_table_end(&p->page);
    if (failed > shown)
        html_paragraph(&p->page, "The first %d of %lld; summary.csv has all.", FAILED_MOST, (long long)failed);
}
