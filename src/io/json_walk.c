#include "io/json_walk.h"

#include "base/number_text.h"
#include "io/utf8.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

json_walk json_walk_begin(const char *name, const char *data, size_t size, int32_t depth_limit)
{
    json_walk w = {name, data, data + size, data, 1, 0, depth_limit};
    w.at = w.line_start = data + utf8_mark(data, size);
    return w;
}

int32_t json_walk_column(const json_walk *w)
{
    ptrdiff_t column = w->at - w->line_start + 1;
    return column < INT32_MAX ? (int32_t)column : INT32_MAX;
}

fram_status json_walk_refuse(const json_walk *w, const char *key, fram_error *error, const char *format, ...)
{
    char text[384];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    error_set(error, FRAM_ERROR_INPUT, w->name, w->line, key, "%s", text);
    if (error)
        error->column = json_walk_column(w);
    return FRAM_ERROR_INPUT;
}

static void skip_blanks(json_walk *w)
{
    for (; w->at < w->end; w->at++) {
        if (*w->at == '\n') {
            w->line++;
            w->line_start = w->at + 1;
        } else if (*w->at != ' ' && *w->at != '\t' && *w->at != '\r') {
            return;
        }
    }
}

/* "expected X, found ..." */
static fram_status refuse_next(const json_walk *w, fram_error *error, const char *expected)
{
    if (w->at == w->end)
        return json_walk_refuse(w, NULL, error, "expected %s, found the end of the file", expected);
    unsigned char c = (unsigned char)*w->at;
    if (c < 0x20 || c >= 0x7f)
        return json_walk_refuse(w, NULL, error, "expected %s, found the byte 0x%02x", expected, c);
    return json_walk_refuse(w, NULL, error, "expected %s, found '%c'", expected, c);
}

fram_status json_walk_kind(json_walk *w, json_kind *kind, fram_error *error)
{
    skip_blanks(w);
    switch (w->at < w->end ? *w->at : '\0') {
    case '{':
        *kind = JSON_OBJECT;
        return FRAM_OK;
    case '[':
        *kind = JSON_ARRAY;
        return FRAM_OK;
    case '"':
        *kind = JSON_STRING;
        return FRAM_OK;
    case 't':
        *kind = JSON_TRUE;
        return FRAM_OK;
    case 'f':
        *kind = JSON_FALSE;
        return FRAM_OK;
    case 'n':
        *kind = JSON_NULL;
        return FRAM_OK;
    default:
        *kind = JSON_NUMBER;
        break;
    }
    if (w->at == w->end || !(*w->at == '-' || (*w->at >= '0' && *w->at <= '9')))
        return refuse_next(w, error, "a value");
    return FRAM_OK;
}

/* ---- objects and arrays ---- */

json_loop json_walk_into(json_walk *w, json_kind kind, fram_error *error)
{
    json_loop loop = {FRAM_OK, true};
    skip_blanks(w);
    if (w->at == w->end || *w->at != (kind == JSON_OBJECT ? '{' : '['))
        loop.status = refuse_next(w, error, kind == JSON_OBJECT ? "an object, '{'" : "an array, '['");
    else if (w->depth == w->depth_limit)
        loop.status =
            json_walk_refuse(w, NULL, error, "objects and arrays are nested more than %d deep", (int)w->depth_limit);
    if (loop.status != FRAM_OK)
        return loop;
    w->depth++;
    w->at++;
    return loop;
}

/* Past the comma before the next item, or the end of all. */
static bool next_item(json_walk *w, json_loop *loop, char close, fram_error *error)
{
    bool first = loop->first;
    loop->first = false;
    if (loop->status != FRAM_OK)
        return false;
    skip_blanks(w);
    if (w->at < w->end && *w->at == close) {
        w->depth--;
        w->at++;
        return false;
    }
    if (first)
        return true;
    if (w->at == w->end || *w->at != ',') {
        loop->status = refuse_next(w, error, close == ']' ? "',' or ']'" : "',' or '}'");
        return false;
    }
    w->at++;
    skip_blanks(w);
    return true;
}

bool json_walk_next(json_walk *w, json_loop *loop, fram_error *error) { return next_item(w, loop, ']', error); }

static fram_status read_name(json_walk *w, char *key, size_t room, fram_error *error)
{
    if (w->at == w->end || *w->at != '"')
        return refuse_next(w, error, "the name of a member in quotes");
    fram_status status = json_walk_text(w, key, room, error);
    if (status != FRAM_OK)
        return status;
    skip_blanks(w);
    if (w->at == w->end || *w->at != ':')
        return refuse_next(w, error, "':'");
    w->at++;
    skip_blanks(w);
    return FRAM_OK;
}

bool json_walk_next_member(json_walk *w, json_loop *loop, char *key, size_t room, fram_error *error)
{
    if (!next_item(w, loop, '}', error))
        return false;
    loop->status = read_name(w, key, room, error);
    return loop->status == FRAM_OK;
}

/* ---- single values ---- */

static bool is_hexadecimal(char c)
{
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F');
}

/* The value of four hexadecimal digits at `digit`; -1 where there are none. */
static int32_t four_digits(const char *digit, const char *end)
{
    int32_t value = 0;
    for (int k = 0; k < 4; k++) {
        if (end - digit <= k || !is_hexadecimal(digit[k]))
            return -1;
        value = 16 * value + (digit[k] <= '9' ? digit[k] - '0' : (digit[k] | 0x20) - 'a' + 10);
    }
    return value;
}

static bool is_surrogate(int32_t unit, int32_t first) { return unit >= first && unit < first + 0x400; }
enum { HIGH_SURROGATES = 0xd800, LOW_SURROGATES = 0xdc00 };

/* Past \uXXXX, and past the second one where two are a pair of surrogates: what they mean.  One without the other,
   which RFC 8259 allows and no text can hold, is U+FFFD; so is NUL, which would end the text. */
static fram_status pass_code(json_walk *w, int32_t *code, fram_error *error)
{
    int32_t unit = four_digits(w->at + 2, w->end);
    if (unit < 0)
        return refuse_next(w, error, "four hexadecimal digits after \\u");
    w->at += 6;
    *code = unit;
    if (is_surrogate(unit, HIGH_SURROGATES) && w->end - w->at > 2 && w->at[0] == '\\' && w->at[1] == 'u') {
        int32_t low = four_digits(w->at + 2, w->end);
        if (is_surrogate(low, LOW_SURROGATES)) {
            *code = 0x10000 + ((unit - HIGH_SURROGATES) << 10) + (low - LOW_SURROGATES);
            w->at += 6;
        }
    }
    if (*code == 0 || is_surrogate(*code, HIGH_SURROGATES) || is_surrogate(*code, LOW_SURROGATES))
        *code = UTF8_REPLACEMENT;
    return FRAM_OK;
}

/* Past one character of a string, and what it means. */
static fram_status pass_character(json_walk *w, int32_t *code, fram_error *error)
{
    static const char escapes[] = "\"\\/bfnrt", meanings[] = "\"\\/\b\f\n\r\t";
    if (*w->at != '\\') {
        if ((unsigned char)*w->at < 0x20)
            return refuse_next(w, error, "no control character in a string");
        *code = utf8_next(&w->at, w->end);
        return *code < 0 ? refuse_next(w, error, "UTF-8") : FRAM_OK;
    }
    char next = w->end - w->at < 2 ? '\0' : w->at[1];
    if (next == 'u')
        return pass_code(w, code, error);
    const char *found = next ? strchr(escapes, next) : NULL;
    if (!found)
        return refuse_next(w, error, "an escape of JSON");
    *code = (unsigned char)meanings[found - escapes];
    w->at += 2;
    return FRAM_OK;
}

fram_status json_walk_text(json_walk *w, char *text, size_t room, fram_error *error)
{
    size_t length = 0;
    bool cut = false;
    skip_blanks(w);
    if (w->at == w->end || *w->at != '"')
        return refuse_next(w, error, "a string");
    w->at++;
    while (w->at < w->end && *w->at != '"') {
        int32_t code = 0;
        char bytes[UTF8_MOST];
        fram_status status = pass_character(w, &code, error);
        if (status != FRAM_OK)
            return status;
        size_t size = (size_t)utf8_put(code, bytes);
        cut = cut || length + size >= room;
        if (cut)
            continue;
        memcpy(text + length, bytes, size);
        length += size;
    }
    if (w->at == w->end)
        return refuse_next(w, error, "'\"' at the end of a string");
    text[length] = '\0';
    w->at++;
    return FRAM_OK;
}

static const char *pass_digits(const char *at, const char *end)
{
    while (at < end && *at >= '0' && *at <= '9')
        at++;
    return at;
}

/* The end of the longest number of JSON's form at the walk; NULL: there is none. */
static const char *number_end(const json_walk *w)
{
    const char *at = w->at, *digits;
    if (at < w->end && *at == '-')
        at++;
    digits = at;
    at = pass_digits(at, w->end);
    if (at == digits || (at - digits > 1 && *digits == '0'))
        return NULL;
    if (at < w->end && *at == '.') {
        digits = ++at;
        at = pass_digits(at, w->end);
        if (at == digits)
            return NULL;
    }
    if (at < w->end && (*at == 'e' || *at == 'E')) {
        at++;
        if (at < w->end && (*at == '+' || *at == '-'))
            at++;
        digits = at;
        at = pass_digits(at, w->end);
        if (at == digits)
            return NULL;
    }
    return at;
}

fram_status json_walk_number(json_walk *w, double *value, fram_error *error)
{
    json_kind kind;
    fram_status status = json_walk_kind(w, &kind, error);
    if (status != FRAM_OK)
        return status;
    if (kind != JSON_NUMBER)
        return refuse_next(w, error, "a number");
    const char *end = number_end(w);
    if (!end)
        return json_walk_refuse(w, NULL, error,
                                "expected a number as JSON writes it: -12.5e3, without leading zeros or a bare point");
    char text[NUMBER_LENGTH_MOST + 1];
    size_t length = (size_t)(end - w->at);
    if (length > NUMBER_LENGTH_MOST)
        return json_walk_refuse(w, NULL, error, "a number of %zu characters; at most %d are read", length,
                                (int)NUMBER_LENGTH_MOST);
    memcpy(text, w->at, length);
    text[length] = '\0';
    if (real_from_text(text, value) != NUMBER_GOOD)
        return json_walk_refuse(w, NULL, error, "the number %.40s is not finite", text);
    w->at = end;
    return FRAM_OK;
}

static fram_status pass_word(json_walk *w, const char *word, fram_error *error)
{
    size_t length = strlen(word);
    if ((size_t)(w->end - w->at) < length || memcmp(w->at, word, length) != 0)
        return refuse_next(w, error, "true, false or null");
    w->at += length;
    return FRAM_OK;
}

static fram_status skip_single(json_walk *w, json_kind kind, fram_error *error)
{
    char text[2];
    double value;
    switch (kind) {
    case JSON_STRING:
        return json_walk_text(w, text, sizeof text, error);
    case JSON_NUMBER:
        return json_walk_number(w, &value, error);
    case JSON_TRUE:
        return pass_word(w, "true", error);
    case JSON_FALSE:
        return pass_word(w, "false", error);
    default:
        return pass_word(w, "null", error);
    }
}

fram_status json_walk_number_or_null(json_walk *w, double *value, fram_error *error)
{
    json_kind kind;
    fram_status status = json_walk_kind(w, &kind, error);
    if (status != FRAM_OK || kind != JSON_NULL)
        return status == FRAM_OK ? json_walk_number(w, value, error) : status;
    *value = (double)NAN;
    return json_walk_skip(w, error);
}

fram_status json_walk_text_or_null(json_walk *w, char *text, size_t room, fram_error *error)
{
    json_kind kind;
    fram_status status = json_walk_kind(w, &kind, error);
    if (status != FRAM_OK || kind != JSON_NULL)
        return status == FRAM_OK ? json_walk_text(w, text, room, error) : status;
    text[0] = '\0';
    return json_walk_skip(w, error);
}

fram_status json_walk_skip(json_walk *w, fram_error *error)
{
    json_kind kind;
    fram_status status = json_walk_kind(w, &kind, error);
    if (status != FRAM_OK || kind > JSON_ARRAY)
        return status == FRAM_OK ? skip_single(w, kind, error) : status;
    char key[2];
    json_loop loop = json_walk_into(w, kind, error);
    while (kind == JSON_ARRAY ? json_walk_next(w, &loop, error)
                              : json_walk_next_member(w, &loop, key, sizeof key, error))
        loop.status = json_walk_skip(w, error); /* as deep as depth_limit allows */
    return loop.status;
}

fram_status json_walk_end(json_walk *w, fram_error *error)
{
    skip_blanks(w);
    return w->at == w->end ? FRAM_OK : refuse_next(w, error, "the end of the file");
}
