#include "io/yaml_indent.h"
#include "base/text.h"

#include <string.h>

enum { LEVELS_MOST = 64 };

/* A line without its comment. */
typedef struct yaml_line {
    int32_t number, indent; /* from 1; blanks before the text, and after it those of a "- " */
    int32_t name;           /* characters of its key, 0: none */
    const char *text;
    size_t size; /* without blanks at the end; 0: nothing on it */
    bool item;   /* begins with "- " */
} yaml_line;

typedef struct indentation {
    const char *at, *end;
    int32_t number;
    int32_t level[LEVELS_MOST], levels; /* columns at which blocks stand open */
    yaml_line last;
    int32_t bracket_line, bracket_column, brackets; /* the first one that is open, how many */
    yaml_blame *out;
} indentation;

/* Brackets and comments of a line: returns its length without the comment. */
static size_t scan(indentation *r, const char *text, size_t size, int32_t number)
{
    char quote = 0;
    for (size_t i = 0; i < size; i++) {
        char c = text[i];
        if (quote) {
            if (c == '\\' && quote == '"')
                i++;
            else if (c == quote)
                quote = 0;
            continue;
        }
        bool parted = i == 0 || text[i - 1] == ' ';
        if (c == '#' && parted)
            return i;
        if ((c == '"' || c == '\'') && (parted || strchr("[{,:", text[i - 1])))
            quote = c;
        if (c == '[' || c == '{') {
            if (r->brackets++ == 0) {
                r->bracket_line = number;
                r->bracket_column = (int32_t)i + 1;
            }
        }
        if ((c == ']' || c == '}') && r->brackets > 0)
            r->brackets--;
    }
    return size;
}

static bool next_yaml_line(indentation *r, yaml_line *out)
{
    if (r->at >= r->end)
        return false;
    const char *stop = memchr(r->at, '\n', (size_t)(r->end - r->at));
    size_t size = (size_t)((stop ? stop : r->end) - r->at);
    *out = (yaml_line){.number = ++r->number, .text = r->at};
    r->at += size + (stop ? 1 : 0);
    size = scan(r, out->text, size, out->number);
    while (size > 0 && strchr(" \t\r", out->text[size - 1]))
        size--;
    out->size = size;
    while ((size_t)out->indent < size && out->text[out->indent] == ' ')
        out->indent++;
    for (size_t i = (size_t)out->indent; i < size && !out->name; i++)
        if (out->text[i] == ':' && (i + 1 == size || out->text[i + 1] == ' '))
            out->name = (int32_t)i - out->indent;
    out->item = (size_t)out->indent + 1 < size && strncmp(out->text + out->indent, "- ", 2) == 0;
    return true;
}

static bool waits_for_a_block(const yaml_line *l)
{
    char end = l->size > 0 ? l->text[l->size - 1] : ':';
    return l->size == 0 || end == ':' || end == '-' || end == '|' || end == '>';
}

static bool blame(indentation *r, const yaml_line *l, const char *what)
{
    r->out->line = l->number;
    r->out->column = l->indent + 1;
    snprintf(
        r->out->message, sizeof r->out->message,
        "the line is indented by %d blank%s, %s line %d, \"%.*s\": give lines that belong together the same blanks",
        (int)l->indent, l->indent == 1 ? "" : "s", what, (int)r->last.number,
        r->last.name < 40 ? (int)r->last.name : 40, r->last.text + r->last.indent);
    return true;
}

/* YAML allows blanks alone there; an editor shows no difference. */
static bool begins_with_tab(indentation *r, const yaml_line *l)
{
    if (l->text[l->indent] != '\t')
        return false;
    r->out->line = l->number;
    r->out->column = l->indent + 1;
    snprintf(r->out->message, sizeof r->out->message, "the line begins with a tab: indent by blanks");
    return true;
}

/* Whether the line fits; opens and closes levels. */
static bool line_is_at_fault(indentation *r, const yaml_line *l)
{
    int32_t closed = 0;
    while (r->levels > 0 && r->level[r->levels - 1] > l->indent) {
        r->levels--;
        closed++;
    }
    bool fits = r->levels > 0 && r->level[r->levels - 1] == l->indent;
    if (!fits && closed > 0 && r->last.name > 0)
        return blame(r, l, "as no block above is; the last line before is");
    if (!fits && !waits_for_a_block(&r->last) && r->last.name > 0 && l->name > 0)
        return blame(r, l, "and stands under a key that has its value:");
    if (!fits && r->levels < LEVELS_MOST)
        r->level[r->levels++] = l->indent;
    for (int32_t at = l->indent; l->item && r->levels < LEVELS_MOST && l->text[at] == '-';) {
        /* What follows "- " is a block of its own. */
        do
            at++;
        while ((size_t)at < l->size && l->text[at] == ' ');
        r->level[r->levels++] = at;
        if ((size_t)at + 1 >= l->size || l->text[at + 1] != ' ')
            break;
    }
    return false;
}

bool yaml_indent_blame(const char *data, size_t size, yaml_blame *out)
{
    indentation r = {.at = data, .end = data + size, .out = out};
    yaml_line line;
    int32_t open = 0;
    while (next_yaml_line(&r, &line)) {
        bool inside = open > 0; /* of brackets, where blanks do not count */
        open = r.brackets;
        if (inside || line.size == 0)
            continue;
        if (begins_with_tab(&r, &line) || line_is_at_fault(&r, &line))
            return true;
        r.last = line;
    }
    if (r.brackets == 0)
        return false;
    out->line = r.bracket_line;
    out->column = r.bracket_column;
    snprintf(out->message, sizeof out->message, "the bracket that opens here is not closed");
    return true;
}

bool yaml_indent_brackets(const char *data, size_t size, size_t most, yaml_blame *out)
{
    indentation r = {.at = data, .end = data + size};
    const char *begin = data; /* behind the last line at whose end no bracket was open */
    yaml_line line;
    for (int32_t open = 0; next_yaml_line(&r, &line); open = r.brackets) {
        if ((open > 0 || r.bracket_line == line.number) && (size_t)(r.at - begin) > most) {
            out->line = r.bracket_line;
            out->column = r.bracket_column;
            snprintf(out->message, sizeof out->message,
                     "expected at most %zu bytes in brackets, found more: write each key on a line of its own", most);
            return true;
        }
        if (r.brackets == 0)
            begin = r.at;
    }
    return false;
}
