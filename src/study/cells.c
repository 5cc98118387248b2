#include "study/cells.h"

#include "base/number_text.h"

#include <math.h>
#include <string.h>

void cell_number(context *ctx, text_buffer *b, double value)
{
    cell_end(ctx, b, isfinite(value) ? value : (double)NAN);
}

void cell_end(context *ctx, text_buffer *b, double value)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_text(value, text);
    text_format(ctx, b, ",%s", isnan(value) ? "" : text);
}

void cell_quoted(context *ctx, text_buffer *b, const char *text)
{
    text_add(ctx, b, ",\"");
    for (const char *c = text; *c; c++)
        text_format(ctx, b, *c == '"' ? "\"\"" : "%c", *c);
    text_add(ctx, b, "\"");
}

void cell_text(context *ctx, text_buffer *b, const char *text)
{
    if (strpbrk(text, ",\""))
        cell_quoted(ctx, b, text);
    else
        text_format(ctx, b, ",%s", text);
}
