/* What kind of file fram field was given: a scenario or outlines. */
#include "cli/field_words.h"

#include <stdio.h>
#include <string.h>

/* Names of the members of GeoJSON's objects; a scenario has none of them at its root. */
enum { GEOJSON_NAMES = 5, GEOJSON_NAME_ROOM = 16 };
static const char *const geojson_name[GEOJSON_NAMES] = {"type", "features", "geometry", "geometries", "coordinates"};

static bool is_geojson_name(const char *name)
{
    for (int i = 0; i < GEOJSON_NAMES; i++)
        if (strcmp(name, geojson_name[i]) == 0)
            return true;
    return false;
}

/* The next character that is no blank, EOF at the end. */
static int next_mark(FILE *file)
{
    int c = getc(file);
    while (c == ' ' || c == '\t' || c == '\r' || c == '\n')
        c = getc(file);
    return c;
}

/* The first one of a file, below comments of YAML. */
static int first_mark(FILE *file)
{
    int c = next_mark(file);
    while (c == '#') {
        while (c != '\n' && c != EOF)
            c = getc(file);
        c = next_mark(file);
    }
    return c;
}

/* The rest of a text in quotes, cut to the room. */
static void read_quoted(FILE *file, char text[GEOJSON_NAME_ROOM])
{
    int length = 0;
    for (int c = getc(file); c != '"' && c != EOF; c = getc(file)) {
        if (length < GEOJSON_NAME_ROOM - 1)
            text[length++] = (char)c;
        if (c == '\\')
            getc(file);
    }
    text[length] = '\0';
}

/* Whether the object that the file stands in has no member of GeoJSON: the first one is as far as it reads, which is
   the beginning of what programs write. */
static bool lacks_geojson_members(FILE *file)
{
    int depth = 1;
    bool at_name = true;
    for (int c = next_mark(file); c != EOF && depth > 0; c = next_mark(file)) {
        char text[GEOJSON_NAME_ROOM] = "";
        if (c == '"')
            read_quoted(file, text);
        if (at_name && is_geojson_name(text))
            return false;
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        at_name = depth == 1 && c == ',';
    }
    return true;
}

/* JSON is YAML too. */
static bool is_json_scenario(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return false;
    int first = first_mark(file);
    if (first == 0xef && getc(file) == 0xbb && getc(file) == 0xbf) /* a byte order mark */
        first = first_mark(file);
    bool scenario = first == '{' && lacks_geojson_members(file);
    fclose(file);
    return scenario;
}

bool field_is_scenario(const char *path)
{
    const char *dot = strrchr(path, '.');
    if (dot && strcmp(dot, ".json") == 0)
        return is_json_scenario(path);
    return dot && (strcmp(dot, ".yaml") == 0 || strcmp(dot, ".yml") == 0);
}
