/* Well-known text; see outline_file.h. */
#include "io/geojson.h"
#include "io/outline_walk.h"

#include <string.h>

enum { WORD_MOST = 32, COORDINATES_MOST = 4 };

/* Blanks, ends of lines, and what # begins to the end of its line. */
static void skip_space(outline_walk *w)
{
    while (w->at < w->end) {
        outline_skip_blanks(w);
        if (w->at == w->end)
            return;
        if (*w->at != '\n' && *w->at != '#')
            return;
        outline_skip_line(w);
    }
}

static bool is_letter(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z'); }

/* The word that begins here, in capitals; empty when none does. */
static void peek_word(const outline_walk *w, char out[WORD_MOST])
{
    int length = 0;
    while (w->at + length < w->end && length + 1 < WORD_MOST && is_letter(w->at[length])) {
        char c = w->at[length];
        out[length++] = (char)(c >= 'a' ? c - 'a' + 'A' : c);
    }
    out[length] = '\0';
}

/* Passes over a word if it is the one that comes. */
static bool take_word(outline_walk *w, const char *word)
{
    char next[WORD_MOST];
    skip_space(w);
    peek_word(w, next);
    if (strcmp(next, word) != 0)
        return false;
    w->at += strlen(word);
    return true;
}

static bool take_character(outline_walk *w, char c)
{
    skip_space(w);
    if (w->at == w->end || *w->at != c)
        return false;
    w->at++;
    return true;
}

static fram_status expect_character(outline_walk *w, char c)
{
    return take_character(w, c) ? FRAM_OK : outline_refuse(w, "expected %c here", c);
}

/* x, y and up to two more numbers, which are passed over. */
static fram_status read_wkt_position(outline_walk *w)
{
    double value[COORDINATES_MOST];
    int count = 0;
    for (skip_space(w); w->at < w->end && *w->at != ',' && *w->at != ')'; skip_space(w)) {
        if (count == COORDINATES_MOST)
            return outline_refuse(w, "expected a position of 2 to %d numbers, found more", (int)COORDINATES_MOST);
        fram_status status = outline_number(w, &value[count++]);
        if (status != FRAM_OK)
            return status;
    }
    if (count < 2)
        return outline_refuse(w, "expected a position of 2 to %d numbers, found %d", (int)COORDINATES_MOST, count);
    return outline_ring_add(w, vec2_make(value[0], value[1]));
}

static fram_status read_wkt_ring(outline_walk *w, int32_t number)
{
    skip_space(w);
    fram_status status = outline_ring_begin(w, number);
    if (status == FRAM_OK)
        status = expect_character(w, '(');
    bool more = true;
    while (status == FRAM_OK && more) {
        status = read_wkt_position(w);
        more = take_character(w, ',');
    }
    if (status == FRAM_OK)
        status = expect_character(w, ')');
    return status == FRAM_OK ? outline_ring_end(w, false) : status;
}

/* The outline, then its holes. */
static fram_status read_wkt_polygon(outline_walk *w)
{
    w->place.polygon++;
    if (take_word(w, "EMPTY"))
        return FRAM_OK;
    fram_status status = expect_character(w, '(');
    bool more = true;
    for (int32_t ring = 1; status == FRAM_OK && more; ring++) {
        status = read_wkt_ring(w, ring);
        more = status == FRAM_OK && take_character(w, ',');
    }
    return status == FRAM_OK ? expect_character(w, ')') : status;
}

static fram_status read_wkt_polygons(outline_walk *w)
{
    if (take_word(w, "EMPTY"))
        return FRAM_OK;
    fram_status status = expect_character(w, '(');
    bool more = true;
    while (status == FRAM_OK && more) {
        status = read_wkt_polygon(w);
        more = status == FRAM_OK && take_character(w, ',');
    }
    return status == FRAM_OK ? expect_character(w, ')') : status;
}

static fram_status read_wkt_geometry(outline_walk *w)
{
    if (w->place.feature == GEOJSON_FEATURES_MOST)
        return outline_refuse(w, "the file has more than %d geometries", (int)GEOJSON_FEATURES_MOST);
    w->place.feature++;
    w->place.polygon = 0;
    bool many = take_word(w, "MULTIPOLYGON");
    if (!many && !take_word(w, "POLYGON")) {
        char word[WORD_MOST];
        peek_word(w, word);
        return outline_refuse(w, "expected POLYGON or MULTIPOLYGON, or lines of x and y without a heading, found %s",
                              word[0] ? word : "no word");
    }
    if (!take_word(w, "ZM") && !take_word(w, "Z"))
        (void)take_word(w, "M");
    return many ? read_wkt_polygons(w) : read_wkt_polygon(w);
}

fram_status outline_read_wkt(outline_walk *w)
{
    fram_status status = FRAM_OK;
    for (skip_space(w); status == FRAM_OK && w->at < w->end; skip_space(w))
        status = read_wkt_geometry(w);
    return status;
}
