/* fram view: a playback page. */
#include "cli/cli.h"

#include <string.h>
#include <unistd.h>

enum { PATH_SIZE = 1024 };

/* The viewer's page beside the command: in the build tree, or where it was installed. */
static bool find_page(char out[PATH_SIZE])
{
    static const char *const places[] = {"../viewer/playback.html", "../share/fram/playback.html"};
    char self[PATH_SIZE / 2];
    ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
    if (length <= 0)
        return false;
    self[length] = '\0';
    char *slash = strrchr(self, '/');
    if (!slash)
        return false;
    *slash = '\0';
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        snprintf(out, PATH_SIZE, "%s/%s", self, places[i]);
        if (access(out, R_OK) == 0)
            return true;
    }
    return false;
}

static void print_result(const common_options *common, const char *output, int64_t frames, int64_t left_out)
{
    if (!common->quiet)
        fprintf(stderr, "%s: %lld frames%s; open it in a browser\n", output, (long long)frames,
                left_out > 0 ? " (others left out to keep the page small)" : "");
    if (!common->json)
        return;
    json j = json_begin();
    json_text(&j, "page", output);
    json_integer(&j, "frames", frames);
    json_integer(&j, "frames_left_out", left_out);
    json_end(&j);
}

int command_view(const command_row *self, int argc, char **argv)
{
    common_options common;
    const char *folder = NULL, *output = NULL, *page = NULL;
    const option_row rows[] = {
        {"--output", "-o", OPTION_TEXT, &output, "FILE", "the page (RUN/playback.html)"},
        {"--page", NULL, OPTION_TEXT, &page, "FILE", "the viewer's page, if it is not beside the command"},
    };
    int code = options_read(self, rows, sizeof rows / sizeof *rows, &common, argc, argv, &folder, 1);
    if (code >= 0)
        return code;
    char found[PATH_SIZE], beside[PATH_SIZE];
    if (!page && !find_page(found))
        return answer_usage(&common, "--page",
                            "the viewer's page is not there: build it with make viewer, or name it with --page FILE");
    if (!page)
        page = found;
    if (!output) {
        snprintf(beside, sizeof beside, "%s/playback.html", folder);
        output = beside;
    }
    fram_context *context = NULL;
    code = session_open(&common, &context);
    if (code >= 0)
        return code;
    int64_t frames = 0, left_out = 0;
    fram_error error = {0};
    if (fram_playback(context, folder, page, output, &frames, &left_out, &error) != FRAM_OK) {
        code = answer_error(&common, &error);
    } else {
        code = EXIT_GOOD;
        print_result(&common, output, frames, left_out);
    }
    fram_context_destroy(context);
    return code;
}
