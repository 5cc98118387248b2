#include "io/page.h"

#include "io/image.h"

#include <string.h>

#ifdef FRAM_HAVE_CAIRO

enum { EDGE = 40, TITLE_SIZE = 20 };

static void draw_page_title(cairo_t *paper, const page *p)
{
    char part[IMAGE_FITTED_SIZE];
    const char *end = p->title_end ? p->title_end : p->title + strlen(p->title);
    const char *fitting = image_fit(paper, TITLE_SIZE, true, p->width - 2 * EDGE, p->title, end, part);
    image_text(paper, EDGE, 38, TITLE_SIZE, ALIGN_LEFT, true, fitting);
}

fram_status page_write(context *ctx, const page *p, const char *path, fram_error *error)
{
    cairo_t *paper = NULL;
    fram_status status = image_begin(p->width, p->height, &paper, error);
    if (status != FRAM_OK)
        return status;
    image_set_colour(paper, (image_colour){0.1, 0.1, 0.1});
    draw_page_title(paper, p);
    image_text_lines(paper, p->text_x, p->text_y, 13, p->text_width, p->text);
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
