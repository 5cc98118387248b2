/* fram view: a playback page. */
#include "cli/cli.h"

/* The viewer's page beside the command: in the build tree, or where it was installed. */
bool viewer_page_find(char out[BESIDE_SIZE])
{
    static const char *const places[] = {"../viewer/playback.html", "../share/fram/playback.html"};
    return find_beside(places, sizeof places / sizeof *places, out);
}

static void print_page(const common_options *common, const char *output, const fram_playback_result *r)
{
    if (!common->quiet) {
        tell(stderr, "%s: %lld frame%s%s", output, (long long)r->frames, plural(r->frames),
             r->left_out > 0 ? " (others left out to keep the page small)" : "");
        if (r->files > 0)
            fprintf(stderr, ", most of them in %lld files in the folder beside it: keep both together",
                    (long long)r->files);
        fprintf(stderr, "; open it in a browser\n");
    }
    if (!common->json)
        return;
    json j = json_begin();
    json_text(&j, "page", output);
    json_integer(&j, "frames", r->frames);
    json_integer(&j, "frames_left_out", r->left_out);
    json_integer(&j, "files", r->files);
    json_end(&j);
}

/* Limits in megabytes; 0: not given. */
#define MEGABYTES_MOST 1e6

static bool is_limit(double megabytes) { return megabytes >= 0 && megabytes <= MEGABYTES_MOST; }
static uint64_t bytes_of(double megabytes) { return (uint64_t)(megabytes * 1e6); }

int command_view(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *folder = NULL;
    double page_mb = 0, total_mb = 0;
    fram_playback_definition definition;
    fram_playback_default(&definition);
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &definition.output, "FILE", "the page (RUN/playback.html)"},
        {"--pressure", NULL, OPTION_TEXT, &definition.pressure, "DIR",
         "also show the pressure on the hull, from a folder that fram pressure wrote of this run"},
        {"--page", NULL, OPTION_TEXT, &definition.viewer_page, "FILE",
         "the viewer's page, if it is not beside the command"},
        {"--page-limit", NULL, OPTION_REAL, &page_mb, "MB",
         "largest page (50); frames of a longer run are put into files beside it"},
        {"--total-limit", NULL, OPTION_REAL, &total_mb, "MB",
         "largest total of page and files (500); beyond it frames are left out"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &folder, 1);
    if (code >= 0)
        return code;
    if (!is_limit(page_mb) || !is_limit(total_mb))
        return answer_usage(&common, is_limit(page_mb) ? "--total-limit" : "--page-limit",
                            "expected megabytes from 0 (as by default) to 1e6");
    char found[BESIDE_SIZE], beside[BESIDE_SIZE];
    if (!definition.viewer_page && !viewer_page_find(found))
        return answer_usage(&common, "--page",
                            "the viewer's page is not there: build it with make viewer, or name it with --page FILE");
    if (!definition.viewer_page)
        definition.viewer_page = found;
    if (!definition.output) {
        snprintf(beside, sizeof beside, "%s/playback.html", folder);
        definition.output = beside;
    }
    definition.folder = folder;
    definition.page_limit = bytes_of(page_mb);
    definition.total_limit = bytes_of(total_mb);
    const command_files files = {.inputs = {definition.viewer_page},
                                 .runs = {folder},
                                 .outputs = {{"--output", definition.output, PAGE_ENDINGS}}};
    work_view work;
    fram_context *context = NULL;
    code = session_open_files(&common, &files, SESSION_MAKES, &work, &context);
    if (code >= 0)
        return code;
    fram_playback_result result = {0};
    fram_error error = {0};
    if (fram_playback(context, &definition, &result, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        print_page(&common, definition.output, &result);
    }
    fram_context_destroy(context);
    return code;
}
