#include "sim/fmu_documentation.h"

#include "base/build_parts.h"
#include "fram/version.h"
#include "io/html_page.h"

#include <stdio.h>

/* The file LICENSE of Fram: who hands a unit on hands the binary on. */
const char fmu_licence[] = "MIT License\n"
                           "\n"
                           "Copyright (c) 2026 Fram contributors\n"
                           "\n"
                           "Permission is hereby granted, free of charge, to any person obtaining a copy\n"
                           "of this software and associated documentation files (the \"Software\"), to deal\n"
                           "in the Software without restriction, including without limitation the rights\n"
                           "to use, copy, modify, merge, publish, distribute, sublicense, and/or sell\n"
                           "copies of the Software, and to permit persons to whom the Software is\n"
                           "furnished to do so, subject to the following conditions:\n"
                           "\n"
                           "The above copyright notice and this permission notice shall be included in all\n"
                           "copies or substantial portions of the Software.\n"
                           "\n"
                           "THE SOFTWARE IS PROVIDED \"AS IS\", WITHOUT WARRANTY OF ANY KIND, EXPRESS OR\n"
                           "IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY,\n"
                           "FITNESS FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE\n"
                           "AUTHORS OR COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER\n"
                           "LIABILITY, WHETHER IN AN ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM,\n"
                           "OUT OF OR IN CONNECTION WITH THE SOFTWARE OR THE USE OR OTHER DEALINGS IN THE\n"
                           "SOFTWARE.\n";

void fmu_dependencies(context *ctx, const fmu_names *names, text_buffer *out)
{
    text_format(
        ctx, out,
        "The binary is made for Linux on x86-64 with the C library of GNU, and loads shared libraries of the system.\n"
        "Fram was built with %s.\n\n"
        "On Debian the package libfram0 of Fram brings what is needed.  What is missing elsewhere is told by\n\n"
        "    ldd binaries/%s/%s.so\n\n"
        "A binary without pictures and NetCDF needs less: \"make python\" in Fram's sources, then\n"
        "\"fram fmu ... --binary build/python/fram_fmu.so\".\n",
        build_parts(), names->version == 3 ? "x86_64-linux" : "linux64", names->identifier);
}

static void add_table(html_page *p, const fmu_variable_array *variables, fmu_kind kind, const char *title)
{
    static const char *const heads[] = {"Variable", "Reference", "Unit", "Meaning", "Start"};
    bool is_input = kind == FMU_INPUT;
    html_section(p, title);
    html_table_begin(p, heads, is_input ? 5 : 4);
    for (int32_t i = 0; i < variables->count; i++) {
        const fmu_variable *v = &variables->data[i];
        char number[16];
        if (v->kind != kind)
            continue;
        snprintf(number, sizeof number, "%d", (int)i);
        html_row_begin(p);
        html_row_name(p, v->name);
        html_cell(p, number);
        html_cell(p, v->unit);
        html_cell(p, v->meaning);
        if (is_input)
            html_number(p, v->start);
        html_row_end(p);
    }
    html_table_end(p);
}

fram_status fmu_page(context *ctx, const scenario *s, const fmu_names *names, const fmu_variable_array *variables,
                     text_buffer *out, fram_error *error)
{
    html_page p = {.ctx = ctx};
    html_begin(&p, names->identifier, s->title);
    html_paragraph(&p,
                   "A vessel in sea ice as a unit for co-simulation by FMI %d.0, made by Fram " FRAM_VERSION
                   ". resources/scenario.yaml is what is simulated, with every key and its meaning.",
                   names->version);
    html_paragraph(
        &p,
        "A communication step is a whole multiple of the time step, %.10g s; any other is refused. Inputs hold "
        "over a communication step. Orders to thrusters are refused while the input positioning is 1: the "
        "vessel's own controller gives them then. States can be kept, set and written as bytes, and the same "
        "steps from a state give the same numbers to the bit.",
        s->run.time_step);
    html_paragraph(&p,
                   "The scenario begins at the importer's start time, and its times (failures, way points, files of "
                   "wind and drift) count from there. What the unit logs of the world has the world's time; where "
                   "the start time is not 0 the importer's time stands behind it.");
    if (names->version == 3)
        html_paragraph(&p,
                       "The importer may look on after every time step (intermediateUpdate), and end a communication "
                       "step there. The variable time is the importer's time.");
    html_paragraph(&p, "SI units, angles in degrees; the global frame has X and Y horizontal, Z up and still water at "
                       "z = 0; forces are on the vessel. Which shared libraries the unit needs stands in "
                       "externalDependencies.txt, its licence in licenses/license.txt.");
    add_table(&p, variables, FMU_INPUT, "Inputs");
    add_table(&p, variables, FMU_OUTPUT, "Outputs");
    html_end(&p);
    if (!p.text.failed)
        text_add_bytes(ctx, out, p.text.data, (size_t)p.text.count);
    html_free(&p);
    return out->failed || !out->data ? error_memory(error) : FRAM_OK;
}
