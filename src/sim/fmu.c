#include "sim/fmu.h"

#include "base/hash.h"
#include "fram/version.h"
#include "io/file.h"
#include "io/scenario_file.h"
#include "io/zip_file.h"
#include "model/scenario_schema.h"
#include "sim/build.h"
#include "sim/controls.h"
#include "sim/fmu_description.h"
#include "sim/fmu_documentation.h"
#include "sim/run_inputs.h"
#include "sim/series.h"

#include <fnmatch.h>
#include <stdio.h>
#include <string.h>

enum { FILE_LIMIT = 1 << 30 };

/* A file of the scenario, and where it lies in resources. */
typedef struct packed_file {
    scenario_text path;
    char name[SCENARIO_TEXT_SIZE + 12];
} packed_file;

typedef struct packer {
    context *ctx;
    const scenario *s;
    const fmu_options *o;
    zip_file zip;
    fmu_variable_array variables;
    control_array controls;
    series_layout columns;
    fmu_names names;
    ARRAY(packed_file) files;
} packer;

/* ---- variables ---- */

static bool is_chosen(const char *name, const char *const *patterns, int count)
{
    for (int i = 0; i < count; i++) {
        if (fnmatch(patterns[i], name, 0) == 0)
            return true;
    }
    return false;
}

/* Every name that was asked for is there. */
static fram_status check_names(const packer *p, bool inputs, fram_error *error)
{
    const char *const *patterns = inputs ? p->o->inputs : p->o->outputs;
    int count = inputs ? p->o->input_count : p->o->output_count;
    for (int k = 0; k < count; k++) {
        int32_t rows = inputs ? p->controls.count : p->columns.columns.count;
        bool found = false;
        for (int32_t i = 0; i < rows && !found; i++)
            found = fnmatch(patterns[k], inputs ? p->controls.data[i].name : p->columns.columns.data[i].name, 0) == 0;
        if (!found)
            return error_set(error, FRAM_ERROR_USAGE, NULL, 0, inputs ? "inputs" : "outputs",
                             "the scenario has no %s \"%s\"", inputs ? "input" : "channel", patterns[k]);
    }
    return FRAM_OK;
}

/* Inputs, then outputs; in 3.0 then the independent variable, which the standard wants: what `time` is there. */
static fram_status choose(packer *p, const model *m, const world *w, fram_error *error)
{
    bool good = true;
    for (int32_t i = 0; i < p->controls.count && good; i++) {
        const control *c = &p->controls.data[i];
        if (p->o->input_count == 0 || is_chosen(c->name, p->o->inputs, p->o->input_count))
            good = array_push(p->ctx, &p->variables,
                              ((fmu_variable){FMU_INPUT, c->role == CONTROL_POSITIONING || c->role == CONTROL_RELEASE,
                                              c->name, c->unit, c->meaning, control_get(m, w, c)}));
    }
    for (int32_t i = 0; i < p->columns.columns.count && good; i++) {
        const csv_column *c = &p->columns.columns.data[i];
        bool of_clock = strcmp(c->name, "time") == 0 || strcmp(c->name, "step_wall_time") == 0;
        if (p->o->version == 3 && strcmp(c->name, "time") == 0)
            continue;
        if (p->o->output_count == 0 ? !of_clock : is_chosen(c->name, p->o->outputs, p->o->output_count))
            good = array_push(
                p->ctx, &p->variables,
                ((fmu_variable){
                    .kind = FMU_OUTPUT, .name = c->name, .unit = c->unit, .meaning = p->o->meaning(c->name)}));
    }
    if (good && p->o->version == 3)
        good =
            array_push(p->ctx, &p->variables,
                       ((fmu_variable){.kind = FMU_TIME, .name = "time", .unit = "s", .meaning = "of the importer"}));
    return good ? FRAM_OK : error_memory(error);
}

/* The world says what it can be told and how that stands; a scenario that cannot be made is refused here. */
static fram_status list_variables(packer *p, fram_error *error)
{
    model m;
    world w;
    field_report report;
    fram_status status = build_model(p->ctx, p->s, &m, error);
    if (status != FRAM_OK)
        return status;
    status = build_world(p->ctx, p->s, &m, &w, &report, error);
    if (status == FRAM_OK) {
        if (!controls_list(p->ctx, p->s, &m, &w, &p->controls))
            status = error_memory(error);
        if (status == FRAM_OK)
            status = series_columns(p->ctx, p->s, &p->columns, error);
        if (status == FRAM_OK)
            status = check_names(p, true, error);
        if (status == FRAM_OK)
            status = check_names(p, false, error);
        if (status == FRAM_OK)
            status = choose(p, &m, &w, error);
        world_free(p->ctx, &w);
    }
    model_free(p->ctx, &m);
    return status;
}

/* ---- names ---- */

/* Whether the language C has the word for itself, as no name of a model may be. */
static bool is_word_of_c(const char *name, size_t length)
{
    static const char *const words[] = {"auto",    "break",  "case",     "char",   "const",    "continue", "default",
                                        "do",      "double", "else",     "enum",   "extern",   "float",    "for",
                                        "goto",    "if",     "inline",   "int",    "long",     "register", "restrict",
                                        "return",  "short",  "signed",   "sizeof", "static",   "struct",   "switch",
                                        "typedef", "union",  "unsigned", "void",   "volatile", "while"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (strlen(words[i]) == length && strncmp(words[i], name, length) == 0)
            return true;
    return false;
}

/* Letters, digits and _ of the output's stem, as the binary's name must be. */
static fram_status name_of(packer *p, fram_error *error)
{
    const char *slash = strrchr(p->o->output, '/'), *stem = slash ? slash + 1 : p->o->output;
    size_t length = strcspn(stem, ".");
    bool letter = length > 0 && ((stem[0] | 32) >= 'a' && (stem[0] | 32) <= 'z');
    for (size_t i = 0; i < length && letter; i++)
        letter =
            (stem[i] >= '0' && stem[i] <= '9') || ((stem[i] | 32) >= 'a' && (stem[i] | 32) <= 'z') || stem[i] == '_';
    if (!letter || length >= sizeof p->names.identifier || strcmp(stem + length, ".fmu") != 0)
        return error_set(
            error, FRAM_ERROR_USAGE, p->o->output, 0, "output",
            "expected NAME.fmu, where NAME, which names the model, is a letter and then letters, digits and _, "
            "at most %d in all",
            (int)sizeof p->names.identifier - 1);
    if (is_word_of_c(stem, length))
        return error_set(error, FRAM_ERROR_USAGE, p->o->output, 0, "output",
                         "expected NAME.fmu, where NAME, which names the model, is no word of the language C, as "
                         "\"%.*s\" is: take my_%.*s.fmu",
                         (int)length, stem, (int)length, stem);
    memcpy(p->names.identifier, stem, length);
    return FRAM_OK;
}

/* A guid of all that the importer relies on: scenario, its files, variables. */
static fram_status find_guid(packer *p, const char *list, fram_error *error)
{
    char hash[SHA256_TEXT_SIZE], digest[SHA256_TEXT_SIZE];
    text_buffer inputs = {0}, all = {0};
    fram_status status = scenario_hash(p->ctx, p->s, hash, error);
    if (status == FRAM_OK)
        status = run_inputs_list(p->ctx, p->s, NULL, &inputs, error);
    if (status == FRAM_OK) {
        text_format(p->ctx, &all, "%s %s\n%s", FRAM_VERSION, hash, list);
        run_input file;
        for (const char *at = inputs.data, *end = at + inputs.count; run_inputs_next(&at, end, &file);)
            text_add(p->ctx, &all, file.digest);
        status = all.failed ? error_memory(error) : FRAM_OK;
    }
    if (status == FRAM_OK) {
        sha256_text(all.data, (size_t)all.count, digest);
        snprintf(p->names.guid, sizeof p->names.guid, "{%.8s-%.4s-%.4s-%.4s-%.12s}", digest, digest + 8, digest + 12,
                 digest + 16, digest + 20);
    }
    text_free(p->ctx, &inputs);
    text_free(p->ctx, &all);
    return status;
}

/* ---- files ---- */

static const char *name_of_file(void *user, const char *path)
{
    const packer *p = user;
    for (int32_t i = 0; i < p->files.count; i++) {
        if (strcmp(p->files.data[i].path, path) == 0)
            return p->files.data[i].name;
    }
    return NULL;
}

static bool is_taken(const packer *p, const char *name)
{
    bool taken = strcmp(name, "scenario.yaml") == 0 || strcmp(name, "variables.txt") == 0;
    for (int32_t i = 0; i < p->files.count && !taken; i++)
        taken = strcmp(p->files.data[i].name, name) == 0;
    return taken;
}

/* Every file of the scenario once, by its own name, in a folder of its own where that name is taken. */
static fram_status list_file(void *user, const scenario_key *key, const void *member, const char *path_of_key,
                             fram_error *error)
{
    packer *p = user;
    const char *given = member;
    packed_file f = {0};
    if (key->kind != KEY_PATH || !*given)
        return FRAM_OK;
    fram_status status = scenario_absolute_path(p->s, path_of_key, given, f.path, error);
    if (status != FRAM_OK || name_of_file(p, f.path))
        return status;
    scenario_text stem;
    const char *slash = strrchr(f.path, '/');
    snprintf(stem, sizeof stem, "%s", slash ? slash + 1 : f.path);
    for (char *c = stem; *c; c++)
        *c = *c == '\\' ? '_' : *c; /* archives take it for a slash */
    snprintf(f.name, sizeof f.name, "%s", stem);
    if (is_taken(p, f.name))
        snprintf(f.name, sizeof f.name, "%d/%s", (int)p->files.count + 1, stem);
    return array_push(p->ctx, &p->files, f) ? FRAM_OK : error_memory(error);
}

static bool has_text(const char *data, size_t size, const char *text)
{
    size_t length = strlen(text);
    const char *end = data + size;
    while ((size_t)(end - data) >= length) {
        const char *at = memchr(data, text[0], (size_t)(end - data) - length + 1);
        if (!at || memcmp(at, text, length) == 0)
            return at != NULL;
        data = at + 1;
    }
    return false;
}

/* An importer would say no more than that it cannot load the unit.  The name of the function that it calls first is
   put together here: the library holds it nowhere else. */
static fram_status check_binary(const packer *p, const char *path, const char *data, size_t size, fram_error *error)
{
    static const char elf[] = {0x7f, 'E', 'L', 'F'};
    char name[40];
    snprintf(name, sizeof name, "fmi%dInstantiate%s", p->o->version, p->o->version == 3 ? "CoSimulation" : "");
    bool library = size >= sizeof elf && memcmp(data, elf, sizeof elf) == 0;
    if (library && has_text(data, size, name))
        return FRAM_OK;
    return error_set(error, FRAM_ERROR_INPUT, path, 0, "binary",
                     "expected a shared library (ELF), as fram_fmu.so is, found %s",
                     library ? "a shared library, but not fram_fmu.so" : "another file");
}

static fram_status pack_file(packer *p, const char *path, const char *name, bool library, fram_error *error)
{
    char *data;
    size_t size;
    fram_status status = file_read(p->ctx, path, FILE_LIMIT, &data, &size, error);
    if (status != FRAM_OK)
        return status;
    if (library)
        status = check_binary(p, path, data, size, error);
    if (status == FRAM_OK)
        status = zip_add(&p->zip, name, data, size, library, error);
    memory_free(p->ctx, data);
    return status;
}

static fram_status pack_text(packer *p, const char *name, const text_buffer *text, fram_error *error)
{
    if (text->failed)
        return error_memory(error);
    return zip_add(&p->zip, name, text->data, (size_t)text->count, false, error);
}

static fram_status pack_scenario(packer *p, fram_error *error)
{
    const scenario_print_options options = {.comments = true, .file_name = name_of_file, .file_user = p};
    text_buffer text = {0};
    fram_status status = scenario_walk(p->s, list_file, p, error);
    if (status == FRAM_OK)
        status = scenario_print(p->ctx, p->s, &options, &text, error);
    if (status == FRAM_OK)
        status = pack_text(p, "resources/scenario.yaml", &text, error);
    text_free(p->ctx, &text);
    for (int32_t i = 0; i < p->files.count && status == FRAM_OK; i++) {
        char name[sizeof p->files.data->name + 12];
        snprintf(name, sizeof name, "resources/%s", p->files.data[i].name);
        status = pack_file(p, p->files.data[i].path, name, false, error);
    }
    return status;
}

static fram_status pack_documentation(packer *p, fram_error *error)
{
    text_buffer page = {0}, needs = {0};
    fram_status status = fmu_page(p->ctx, p->s, &p->names, &p->variables, &page, error);
    fmu_dependencies(p->ctx, &p->names, &needs);
    if (status == FRAM_OK)
        status = pack_text(p, "documentation/index.html", &page, error);
    if (status == FRAM_OK)
        status = pack_text(p, "documentation/externalDependencies.txt", &needs, error);
    if (status == FRAM_OK)
        status = zip_add(&p->zip, "documentation/licenses/license.txt", fmu_licence, strlen(fmu_licence), false, error);
    text_free(p->ctx, &page);
    text_free(p->ctx, &needs);
    return status;
}

static fram_status pack_all(packer *p, fram_error *error)
{
    char name[sizeof p->names.identifier + 40];
    static const char *const kinds[] = {[FMU_INPUT] = "input", [FMU_OUTPUT] = "output", [FMU_TIME] = "time"};
    text_buffer list = {0}, text = {0};
    for (int32_t i = 0; i < p->variables.count; i++)
        text_format(p->ctx, &list, "%s %s\n", kinds[p->variables.data[i].kind], p->variables.data[i].name);
    text_add(p->ctx, &list, "");
    fram_status status = list.failed ? error_memory(error) : find_guid(p, list.data, error);
    if (status == FRAM_OK) {
        fmu_describe(p->ctx, p->s, &p->names, &p->variables, &text);
        status = pack_text(p, "modelDescription.xml", &text, error);
    }
    snprintf(name, sizeof name, "binaries/%s/%s.so", p->o->version == 3 ? "x86_64-linux" : "linux64",
             p->names.identifier);
    if (status == FRAM_OK)
        status = pack_file(p, p->o->binary, name, true, error);
    if (status == FRAM_OK)
        status = pack_documentation(p, error);
    if (status == FRAM_OK)
        status = pack_scenario(p, error);
    if (status == FRAM_OK) {
        text.count = 0;
        text_format(p->ctx, &text, "%s\n%s", p->names.guid, list.data);
        status = pack_text(p, "resources/variables.txt", &text, error);
    }
    text_free(p->ctx, &list);
    text_free(p->ctx, &text);
    return status == FRAM_OK ? zip_write(&p->zip, p->o->output, error) : status;
}

fram_status fmu_write(context *ctx, const scenario *s, const fmu_options *options, fmu_report *report,
                      fram_error *error)
{
    packer p = {.ctx = ctx, .s = s, .o = options, .zip = {.ctx = ctx}, .names = {.version = options->version}};
    *report = (fmu_report){0};
    fram_status status = name_of(&p, error);
    if (status == FRAM_OK)
        status = list_variables(&p, error);
    if (status == FRAM_OK)
        status = pack_all(&p, error);
    for (int32_t i = 0; i < p.variables.count; i++) {
        report->inputs += p.variables.data[i].kind == FMU_INPUT;
        report->outputs += p.variables.data[i].kind == FMU_OUTPUT;
    }
    report->files = p.files.count;
    zip_free(&p.zip);
    array_free(ctx, &p.variables);
    array_free(ctx, &p.controls);
    series_layout_free(ctx, &p.columns);
    array_free(ctx, &p.files);
    return status;
}
