#include "sim/fmu_description.h"

#include "base/number_text.h"
#include "fram/version.h"

#include <math.h>
#include <string.h>

/* Units of channels by the SI's base units. */
static const struct {
    const char *name, *base;
} units[] = {
    {"s", "s=\"1\""},
    {"m", "m=\"1\""},
    {"m2", "m=\"2\""},
    {"kg", "kg=\"1\""},
    {"m/s", "m=\"1\" s=\"-1\""},
    {"rad/s", "rad=\"1\" s=\"-1\""},
    {"deg", "rad=\"1\" factor=\"0.017453292519943295\""},
    {"rad", "rad=\"1\""},
    {"N", "kg=\"1\" m=\"1\" s=\"-2\""},
    {"N m", "kg=\"1\" m=\"2\" s=\"-2\""},
    {"N s", "kg=\"1\" m=\"1\" s=\"-1\""},
    {"J", "kg=\"1\" m=\"2\" s=\"-2\""},
    {"W", "kg=\"1\" m=\"2\" s=\"-3\""},
    {"Pa", "kg=\"1\" m=\"-1\" s=\"-2\""},
};

static const char *base_of(const char *unit)
{
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (strcmp(unit, units[i].name) == 0)
            return units[i].base;
    }
    return NULL;
}

/* Text in a quoted attribute; what XML has no character for becomes a question mark. */
static void add_quoted(context *ctx, text_buffer *out, const char *text)
{
    text_add(ctx, out, "\"");
    for (; *text; text++) {
        const char *name = *text == '&'   ? "&amp;"
                           : *text == '<' ? "&lt;"
                           : *text == '>' ? "&gt;"
                           : *text == '"' ? "&quot;"
                                          : NULL;
        if (name)
            text_add(ctx, out, name);
        else if ((unsigned char)*text < 0x20)
            text_add(ctx, out, "?");
        else
            text_add_bytes(ctx, out, text, 1);
    }
    text_add(ctx, out, "\"");
}

static void add_attribute(context *ctx, text_buffer *out, const char *name, const char *value)
{
    text_format(ctx, out, " %s=", name);
    add_quoted(ctx, out, value);
}

static void add_real(context *ctx, text_buffer *out, const char *name, double value)
{
    char text[NUMBER_TEXT_SIZE];
    real_to_text(isfinite(value) ? value : 0, text);
    text_format(ctx, out, " %s=\"%s\"", name, text);
}

/* A unit that is without dimension has no entry and is not named. */
static bool is_named(const char *unit) { return *unit && strcmp(unit, "1") != 0; }

static void add_units(context *ctx, const fmu_variable_array *variables, text_buffer *out)
{
    bool any = false;
    for (int32_t i = 0; i < variables->count; i++) {
        const char *unit = variables->data[i].unit;
        bool again = false;
        for (int32_t k = 0; k < i && !again; k++)
            again = strcmp(variables->data[k].unit, unit) == 0;
        if (again || !is_named(unit))
            continue;
        text_add(ctx, out, any ? "" : "  <UnitDefinitions>\n");
        any = true;
        text_add(ctx, out, "    <Unit");
        add_attribute(ctx, out, "name", unit);
        if (base_of(unit))
            text_format(ctx, out, "><BaseUnit %s/></Unit>\n", base_of(unit));
        else
            text_add(ctx, out, "/>\n");
    }
    text_add(ctx, out, any ? "  </UnitDefinitions>\n" : "");
}

static void add_variable(context *ctx, const fmu_variable *v, int32_t reference, text_buffer *out)
{
    text_add(ctx, out, "    <ScalarVariable");
    add_attribute(ctx, out, "name", v->name);
    text_format(ctx, out, " valueReference=\"%d\"", (int)reference);
    if (v->meaning[0])
        add_attribute(ctx, out, "description", v->meaning);
    text_add(ctx, out,
             v->is_input ? " causality=\"input\" variability=\"continuous\"><Real"
                         : " causality=\"output\" variability=\"continuous\" initial=\"calculated\"><Real");
    if (is_named(v->unit))
        add_attribute(ctx, out, "unit", v->unit);
    if (v->is_input)
        add_real(ctx, out, "start", v->start);
    text_add(ctx, out, "/></ScalarVariable>\n");
}

/* Outputs by their index from 1; they depend on the state alone, no input acts before a step. */
static void add_unknowns(context *ctx, const fmu_variable_array *variables, const char *head, text_buffer *out)
{
    bool any = false;
    for (int32_t i = 0; i < variables->count; i++) {
        if (variables->data[i].is_input)
            continue;
        if (!any)
            text_format(ctx, out, "    <%s>\n", head);
        any = true;
        text_format(ctx, out, "      <Unknown index=\"%d\" dependencies=\"\"/>\n", (int)i + 1);
    }
    if (any)
        text_format(ctx, out, "    </%s>\n", head);
}

void fmu_describe(context *ctx, const scenario *s, const fmu_names *names, const fmu_variable_array *variables,
                  text_buffer *out)
{
    text_add(ctx, out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"2.0\"");
    add_attribute(ctx, out, "modelName", names->identifier);
    add_attribute(ctx, out, "guid", names->guid);
    if (s->title[0])
        add_attribute(ctx, out, "description", s->title);
    text_add(ctx, out,
             " generationTool=\"Fram " FRAM_VERSION "\" variableNamingConvention=\"flat\""
             " numberOfEventIndicators=\"0\">\n  <CoSimulation");
    add_attribute(ctx, out, "modelIdentifier", names->identifier);
    text_add(ctx, out,
             " canHandleVariableCommunicationStepSize=\"true\" canNotUseMemoryManagementFunctions=\"true\""
             " canGetAndSetFMUstate=\"true\" canSerializeFMUstate=\"true\"/>\n");
    add_units(ctx, variables, out);
    text_add(ctx, out,
             "  <LogCategories>\n    <Category name=\"logStatusWarning\"/>\n    <Category name=\"logStatusError\"/>\n"
             "    <Category name=\"logAll\"/>\n  </LogCategories>\n  <DefaultExperiment startTime=\"0\"");
    add_real(ctx, out, "stopTime", s->run.duration);
    add_real(ctx, out, "stepSize", s->run.time_step);
    text_add(ctx, out, "/>\n  <ModelVariables>\n");
    for (int32_t i = 0; i < variables->count; i++)
        add_variable(ctx, &variables->data[i], i, out);
    text_add(ctx, out, "  </ModelVariables>\n  <ModelStructure>\n");
    add_unknowns(ctx, variables, "Outputs", out);
    add_unknowns(ctx, variables, "InitialUnknowns", out);
    text_add(ctx, out, "  </ModelStructure>\n</fmiModelDescription>\n");
}
