#include "io/page.h"

#include "io/image.h"

#include <stdio.h>
#include <string.h>

#ifdef FRAM_HAVE_CAIRO

enum { LINE_HEIGHT = 19, EDGE = 40 };

static void draw_text(cairo_t *paper, const page *p)
{
    int y = p->text_y;
    for (const char *line = p->text; *line;) {
        char one[256];
        size_t length = strcspn(line, "\n");
        snprintf(one, sizeof one, "%.*s", (int)length, line);
        image_text(paper, p->text_x, y, 13, ALIGN_LEFT, false, one);
        y += LINE_HEIGHT;
        line += length + (line[length] == '\n');
    }
}

fram_status page_write(context *ctx, const page *p, const char *path, fram_error *error)
{
    cairo_t *paper = NULL;
    fram_status status = image_begin(p->width, p->height, &paper, error);
    if (status != FRAM_OK)
        return status;
    image_set_colour(paper, (image_colour){0.1, 0.1, 0.1});
    image_text_fitted(paper, EDGE, 38, 20, true, p->width - 2 * EDGE, p->title);
    draw_text(paper, p);
    for (int32_t i = 0; i < p->panel_count; i++) {
        const page_panel *panel = &p->panels[i];
        cairo_save(paper);
        cairo_translate(paper, panel->x, panel->y);
        chart_draw(paper, &panel->chart, panel->width, panel->height, panel->equal);
        cairo_restore(paper);
    }
    return image_write(ctx, paper, path, error);
}

#else

fram_status page_write(context *ctx, const page *p, const char *path, fram_error *error)
{
    (void)ctx, (void)p;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL, "this build has no cairo, so it draws no pages");
}

#endif
