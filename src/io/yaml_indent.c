#include "io/yaml_indent.h"
#include "base/text.h"
#include "io/utf8.h"

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
    char quote;                                     /* the one that is open, or 0 */
    bool begins, ended;                             /* a value may begin here; one in quotes or brackets just ended */
    yaml_blame *out;
} indentation;

static bool parts_words(char c) { return c == ' ' || c == '\t'; }

/* Takes the character at *i, in quotes; behind both of a pair that stands for one within them. */
static void take_quoted(indentation *r, const char *text, size_t size, size_t *i)
{
    bool pair = r->quote == '"' ? text[*i] == '\\' : *i + 1 < size && text[*i] == '\'' && text[*i + 1] == '\'';
    if (pair) {
        (*i)++;
    } else if (text[*i] == r->quote) {
        r->quote = 0;
        r->ended = true;
    }
}

/* Takes the character at i, which is no blank and not in quotes.  One of a plain text is only that, "run [1 of 2". */
static void take_plain(indentation *r, const char *text, size_t size, size_t i, int32_t number)
{
    char c = text[i];
    bool begins = r->begins, ended = r->ended, last = i + 1 == size || parts_words(text[i + 1]);
    r->begins = r->ended = false;
    if (c == '"' || c == '\'')
        r->quote = begins ? c : '\0';
    if ((c == '[' || c == '{') && (begins || r->brackets > 0)) {
        if (r->brackets++ == 0) {
            r->bracket_line = number;
            r->bracket_column = (int32_t)i + 1;
        }
        r->begins = true;
    }
    if ((c == ']' || c == '}') && r->brackets > 0) {
        r->brackets--;
        r->ended = true;
    }
    if (c == ':')
        r->begins = last || ended;
    if (c == ',')
        r->begins = r->brackets > 0;
    if (c == '-' || c == '?')
        r->begins = begins && last;
}

/* Brackets and comments of a line: returns its length without the comment. */
static size_t scan(indentation *r, const char *text, size_t size, int32_t number)
{
    size_t i = number == 1 ? utf8_mark(text, size) : 0;
    if (r->brackets == 0) {
        r->quote = '\0';
        r->begins = true;
        r->ended = false;
    }
    if (size > i + 3 && strncmp(text + i, "---", 3) == 0 && parts_words(text[i + 3]))
        i += 3; /* the mark of a document */
    for (; i < size; i++) {
        if (r->quote) {
            take_quoted(r, text, size, &i);
            continue;
        }
        if (text[i] == '#' && (i == 0 || parts_words(text[i - 1])))
            return i;
        if (r->begins && (text[i] == '&' || text[i] == '!')) /* a name or a kind before the value */
            while (i + 1 < size && !parts_words(text[i + 1]) && !strchr(r->brackets > 0 ? ",[]{}" : "", text[i + 1]))
                i++;
        else if (!parts_words(text[i]))
            take_plain(r, text, size, i, number);
    }
    return size;
}

static bool next_yaml_line(indentation *r, yaml_line *out)
{
    if (r->at >= r->end)
        return false;
    const char *stop = r->at;
    while (stop < r->end && *stop != '\n' && *stop != '\r')
        stop++;
    size_t size = (size_t)(stop - r->at);
    *out = (yaml_line){.number = ++r->number, .text = r->at};
    r->at = stop + (r->end - stop > 1 && stop[0] == '\r' && stop[1] == '\n' ? 2 : stop < r->end);
    size = scan(r, out->text, size, out->number);
    while (size > 0 && strchr(" \t", out->text[size - 1]))
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
