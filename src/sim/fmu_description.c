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

static const char *variability_of(const fmu_variable *v) { return v->is_discrete ? "discrete" : "continuous"; }

static void add_variable_2(context *ctx, const fmu_variable *v, int32_t reference, text_buffer *out)
{
    text_add(ctx, out, "    <ScalarVariable");
    add_attribute(ctx, out, "name", v->name);
    text_format(ctx, out, " valueReference=\"%d\"", (int)reference);
    if (v->meaning[0])
        add_attribute(ctx, out, "description", v->meaning);
    text_format(ctx, out, " causality=\"%s\" variability=\"%s\"%s><Real", v->kind == FMU_INPUT ? "input" : "output",
                variability_of(v), v->kind == FMU_INPUT ? "" : " initial=\"calculated\"");
    if (is_named(v->unit))
        add_attribute(ctx, out, "unit", v->unit);
    if (v->kind == FMU_INPUT)
        add_real(ctx, out, "start", v->start);
    text_add(ctx, out, "/></ScalarVariable>\n");
}

/* What is no input can be looked at between the steps of the world that a communication step has. */
static void add_variable_3(context *ctx, const fmu_variable *v, int32_t reference, text_buffer *out)
{
    static const char *const causality[] = {[FMU_INPUT] = "input", [FMU_OUTPUT] = "output", [FMU_TIME] = "independent"};
    text_add(ctx, out, "    <Float64");
    add_attribute(ctx, out, "name", v->name);
    text_format(ctx, out, " valueReference=\"%d\"", (int)reference);
    if (v->meaning[0])
        add_attribute(ctx, out, "description", v->meaning);
    text_format(ctx, out, " causality=\"%s\" variability=\"%s\"", causality[v->kind], variability_of(v));
    if (v->kind != FMU_INPUT)
        text_add(ctx, out, " intermediateUpdate=\"true\"");
    if (v->kind == FMU_OUTPUT)
        text_add(ctx, out, " initial=\"calculated\"");
    if (is_named(v->unit))
        add_attribute(ctx, out, "unit", v->unit);
    if (v->kind == FMU_INPUT)
        add_real(ctx, out, "start", v->start);
    text_add(ctx, out, "/>\n");
}

/* Outputs, by their index from 1 in 2.0 and by their reference in 3.0; they depend on the state alone, no input acts
   before a step. */
static void add_unknowns(context *ctx, const fmu_variable_array *variables, const char *form, int first,
                         text_buffer *out)
{
    for (int32_t i = 0; i < variables->count; i++) {
        if (variables->data[i].kind == FMU_OUTPUT)
            text_format(ctx, out, "    <%s=\"%d\" dependencies=\"\"/>\n", form, (int)i + first);
    }
}

static void add_structure(context *ctx, const fmu_variable_array *variables, int version, text_buffer *out)
{
    bool any = false;
    for (int32_t i = 0; i < variables->count; i++)
        any = any || variables->data[i].kind == FMU_OUTPUT;
    text_add(ctx, out, "  <ModelStructure>\n");
    if (version == 3) {
        add_unknowns(ctx, variables, "Output valueReference", 0, out);
        add_unknowns(ctx, variables, "InitialUnknown valueReference", 0, out);
    } else if (any) {
        text_add(ctx, out, "    <Outputs>\n");
        add_unknowns(ctx, variables, "Unknown index", 1, out);
        text_add(ctx, out, "    </Outputs>\n    <InitialUnknowns>\n");
        add_unknowns(ctx, variables, "Unknown index", 1, out);
        text_add(ctx, out, "    </InitialUnknowns>\n");
    }
    text_add(ctx, out, "  </ModelStructure>\n");
}

static void add_head(context *ctx, const scenario *s, const fmu_names *names, text_buffer *out)
{
    bool is_3 = names->version == 3;
    text_format(ctx, out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription fmiVersion=\"%d.0\"",
                names->version);
    add_attribute(ctx, out, "modelName", names->identifier);
    add_attribute(ctx, out, is_3 ? "instantiationToken" : "guid", names->guid);
    if (s->title[0])
        add_attribute(ctx, out, "description", s->title);
    text_format(ctx, out, " generationTool=\"Fram " FRAM_VERSION "\" variableNamingConvention=\"flat\"%s>\n",
                is_3 ? "" : " numberOfEventIndicators=\"0\"");
    text_add(ctx, out, "  <CoSimulation");
    add_attribute(ctx, out, "modelIdentifier", names->identifier);
    text_add(ctx, out, " canHandleVariableCommunicationStepSize=\"true\"");
    if (is_3) {
        add_real(ctx, out, "fixedInternalStepSize", s->run.time_step);
        text_add(ctx, out,
                 " canGetAndSetFMUState=\"true\" canSerializeFMUState=\"true\" providesIntermediateUpdate=\"true\""
                 " mightReturnEarlyFromDoStep=\"true\" canReturnEarlyAfterIntermediateUpdate=\"true\""
                 " hasEventMode=\"false\"/>\n");
    } else {
        text_add(ctx, out,
                 " canNotUseMemoryManagementFunctions=\"true\" canGetAndSetFMUstate=\"true\""
                 " canSerializeFMUstate=\"true\"/>\n");
    }
}

/* Where a run of the scenario ends, with the step that ends nearest to its duration: no importer can step on to one
   that is no whole number of steps. */
static double experiment_end(const scenario *s)
{
    double end = (double)scenario_step_at(s->run.duration, s->run.time_step) * s->run.time_step;
    return fabs(end - s->run.duration) < 1e-9 * end ? s->run.duration : end; /* as it was given, but for rounding */
}

void fmu_describe(context *ctx, const scenario *s, const fmu_names *names, const fmu_variable_array *variables,
                  text_buffer *out)
{
    add_head(ctx, s, names, out);
    add_units(ctx, variables, out);
    text_add(ctx, out,
             "  <LogCategories>\n    <Category name=\"logStatusWarning\"/>\n    <Category name=\"logStatusError\"/>\n"
             "    <Category name=\"logAll\"/>\n  </LogCategories>\n  <DefaultExperiment startTime=\"0\"");
    add_real(ctx, out, "stopTime", experiment_end(s));
    add_real(ctx, out, "stepSize", s->run.time_step);
    text_add(ctx, out, "/>\n  <ModelVariables>\n");
    for (int32_t i = 0; i < variables->count; i++)
        (names->version == 3 ? add_variable_3 : add_variable_2)(ctx, &variables->data[i], i, out);
    text_add(ctx, out, "  </ModelVariables>\n");
    add_structure(ctx, variables, names->version, out);
    text_add(ctx, out, "</fmiModelDescription>\n");
}
