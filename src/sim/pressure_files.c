/* Panels as tables, for ParaView and for the playback page. */
#include "sim/hull_pressure_parts.h"

#include "base/transcendental.h"
#include "io/atomic_file.h"
#include "io/path.h"
#include "io/record_layout.h"
#include "io/scenario_file.h"
#include "io/vtk_file.h"
#include "sim/build_ice.h"
#include "sim/run_folder.h"

#include <string.h>

/* Local pressure on thick massive ice by ISO 19906 (2010), A.8.2.5: 7.40 A^-0.70 MPa up to 10 m2, 1.48 MPa above
   [Pa]. */
static double iso_local_pressure(double area) { return area <= 10 ? 7.4e6 * real_pow(area, -0.7) : 1.48e6; }

static fram_status write_text(pressure_map *p, const char *name, text_buffer *text, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = path_own(p->o->output, name, path, error);
    if (status == FRAM_OK)
        status = text_file_write(p->ctx, path, text, error);
    text_free(p->ctx, text);
    return status;
}

static fram_status write_panels(pressure_map *p, fram_error *error)
{
    text_buffer text = {0};
    text_add(
        p->ctx, &text,
        "panel,side,patch,column,row,x[m],y[m],z[m],normal_x,normal_y,normal_z,x_min[m],x_max[m],y_min[m],y_max[m],"
        "z_min[m],z_max[m],area[m2],pressure_mean[Pa],pressure_largest[Pa],time_of_largest[s],"
        "pressure_cumulative[Pa s],force_x[N],force_y[N],force_z[N]\n");
    for (int32_t i = 0; i < p->panels.panel.count; i++) {
        const hull_panel *q = &p->panels.panel.data[i];
        const panel_load *l = &p->load[i];
        vec3 f = vec3_scale(l->impulse, 1 / p->time);
        text_format(p->ctx, &text, "%d,%s,%d,%d,%d,%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,", (int)i + 1,
                    hull_side_name((hull_side)q->side), (int)q->patch + 1, (int)q->column, (int)q->row, q->centre.x,
                    q->centre.y, q->centre.z, q->normal.x, q->normal.y, q->normal.z);
        text_format(p->ctx, &text, "%.9g,%.9g,%.9g,%.9g,%.9g,%.9g,%.12g,", q->bounds.lo.x, q->bounds.hi.x,
                    q->bounds.lo.y, q->bounds.hi.y, q->bounds.lo.z, q->bounds.hi.z, q->area);
        text_format(p->ctx, &text, "%.12g,%.12g,", l->sum / q->area / p->time, l->most / q->area);
        if (l->most > 0) // a panel that met no ice has no such moment
            text_format(p->ctx, &text, "%.9g", l->when);
        text_format(p->ctx, &text, ",%.12g,%.12g,%.12g,%.12g\n", l->sum / q->area, f.x, f.y, f.z);
    }
    return write_text(p, "panels.csv", &text, error);
}

static fram_status write_zones(pressure_map *p, fram_error *error)
{
    static const char *const mechanisms[MECHANISM_COUNT] = {
#define MECHANISM_NAME(id, name, text) [MECHANISM_##id] = (name),
        ICE_MECHANISMS(MECHANISM_NAME)
#undef MECHANISM_NAME
    };
    text_buffer text = {0};
    text_add(p->ctx, &text, "zone,mechanism,force_x[N],force_y[N],force_z[N]\n");
    for (int z = 0; z < ZONE_COUNT; z++)
        for (int m = 0; m < MECHANISM_COUNT; m++) {
            vec3 f = vec3_scale(p->part[z][m], 1 / p->time);
            text_format(p->ctx, &text, "%s,%s,%.12g,%.12g,%.12g\n", hull_zone_name((hull_zone)z), mechanisms[m], f.x,
                        f.y, f.z);
        }
    return write_text(p, "zones.csv", &text, error);
}

static fram_status write_curve(pressure_map *p, fram_error *error)
{
    text_buffer text = {0};
    text_add(p->ctx, &text, "columns,rows,area[m2],pressure_largest[Pa],time[s],iso_19906[Pa]\n");
    for (int k = 0; k < WINDOW_SHAPES; k++) {
        const window_most *m = &p->most[k];
        if (!(m->area > 0))
            continue;
        text_format(p->ctx, &text, "%d,%d,%.12g,%.12g,%.9g,", (int)window_shapes[k].columns, (int)window_shapes[k].rows,
                    m->area, m->pressure, m->time);
        if (!build_is_of_tank(&p->s)) // the standard's pressures are those of the sea
            text_format(p->ctx, &text, "%.12g", iso_local_pressure(m->area));
        text_add(p->ctx, &text, "\n");
    }
    return write_text(p, "area.csv", &text, error);
}

enum { FIELDS = 5 };

static bool fill_hull(pressure_map *p, int32_array *link, int32_array *offset, float_array value[FIELDS])
{
    const hull_panels *h = &p->panels;
    bool good = true;
    for (int32_t i = 0; i < h->facet.count && good; i++) {
        const panel_facet *f = &h->facet.data[i];
        double area = h->panel.data[f->panel].area;
        const panel_load *l = &p->load[f->panel];
        const double part[FIELDS] = {l->sum / p->time / area, l->most / area, l->sum / area, f->panel + 1.0, area};
        for (int32_t k = 0; k < f->count && good; k++)
            good = array_push(p->ctx, link, f->first + k);
        good = good && array_push(p->ctx, offset, link->count);
        for (int k = 0; k < FIELDS && good; k++)
            good = array_push(p->ctx, &value[k], (float)part[k]);
    }
    return good;
}

static fram_status write_hull(pressure_map *p, fram_error *error)
{
    char path[PATH_ROOM];
    float_array value[FIELDS] = {{0}, {0}, {0}, {0}, {0}};
    int32_array link = {0}, offset = {0};
    bool good = fill_hull(p, &link, &offset, value);
    const vtk_field fields[FIELDS] = {{"mean pressure [Pa]", 1, value[0].data},
                                      {"largest pressure [Pa]", 1, value[1].data},
                                      {"cumulative pressure [Pa s]", 1, value[2].data},
                                      {"panel", 1, value[3].data},
                                      {"panel area [m2]", 1, value[4].data}};
    const vtk_data data = {.point = p->panels.corner.data,
                           .point_count = p->panels.corner.count,
                           .kind = VTK_POLYGONS,
                           .connectivity = link.data,
                           .offset = offset.data,
                           .cell_count = offset.count,
                           .fields = fields,
                           .field_count = FIELDS,
                           .time = p->time};
    fram_status status = good ? path_own(p->o->output, "hull.vtp", path, error) : error_memory(error);
    if (status == FRAM_OK)
        status = vtk_write(p->ctx, path, &data, error);
    for (int k = 0; k < FIELDS; k++)
        array_free(p->ctx, &value[k]);
    array_free(p->ctx, &link);
    array_free(p->ctx, &offset);
    return status;
}

/* ---- for the playback page: io/record_layout.h, block 14 ---- */

static void add_int(context *ctx, text_buffer *out, int32_t value)
{
    text_add_bytes(ctx, out, (const char *)&value, sizeof value);
}

static void add_float(context *ctx, text_buffer *out, double value)
{
    float f = (float)value;
    text_add_bytes(ctx, out, (const char *)&f, sizeof f);
}

static void add_triangles(pressure_map *p, text_buffer *out)
{
    const mesh *t = &p->panels.triangle;
    for (int32_t i = 0; i < t->face.count; i++)
        add_int(p->ctx, out, p->panels.triangle_panel.data[i]);
    for (int32_t i = 0; i < t->face.count; i++)
        for (int k = 0; k < 3; k++) {
            vec3 c = vec3_sub(t->vertex.data[t->face.data[i].v[k]], p->centre);
            add_float(p->ctx, out, c.x);
            add_float(p->ctx, out, c.y);
            add_float(p->ctx, out, c.z);
        }
}

static void fill_block(pressure_map *p, const char *hash, text_buffer *out)
{
    const double times[2] = {p->o->from, p->o->from + p->time};
    text_add_bytes(p->ctx, out, hash, PRESSURE_HASH_SIZE);
    text_add_bytes(p->ctx, out, (const char *)times, sizeof times);
    add_int(p->ctx, out, p->vessel);
    add_int(p->ctx, out, p->panels.panel.count);
    add_int(p->ctx, out, p->panels.triangle.face.count);
    add_int(p->ctx, out, 0);
    for (int32_t i = 0; i < p->panels.panel.count; i++) {
        double area = p->panels.panel.data[i].area;
        add_float(p->ctx, out, p->load[i].sum / p->time / area);
        add_float(p->ctx, out, p->load[i].most / area);
        add_float(p->ctx, out, p->load[i].when);
    }
    add_triangles(p, out);
}

static fram_status write_block(pressure_map *p, const char *path, const text_buffer *block, fram_error *error)
{
    record_writer file;
    fram_status status = record_create_beside(p->ctx, path, &file, error);
    if (status != FRAM_OK)
        return status;
    record_part part = {block->data, (size_t)block->count};
    return record_place(&file, record_append(&file, BLOCK_PRESSURE, &part, 1, error), error);
}

static fram_status write_for_page(pressure_map *p, fram_error *error)
{
    char path[PATH_ROOM], hash[SHA256_TEXT_SIZE];
    text_buffer block = {0};
    fram_status status = path_own(p->o->output, "pressure.fram", path, error);
    if (status == FRAM_OK)
        status = scenario_hash(p->ctx, &p->s, hash, error);
    if (status != FRAM_OK)
        return status;
    fill_block(p, hash, &block);
    status = block.failed ? error_memory(error) : write_block(p, path, &block, error);
    text_free(p->ctx, &block);
    return status;
}

bool pressure_is_file(const char *name)
{
    static const char *const names[] = {"panels.csv", "area.csv",      "zones.csv",
                                        "hull.vtp",   "pressure.fram", "pressure.png"};
    bool found = false;
    for (size_t i = 0; i < sizeof names / sizeof *names && !found; i++)
        found = strcmp(name, names[i]) == 0;
    return found;
}

fram_status pressure_write_files(pressure_map *p, fram_error *error)
{
    char path[PATH_ROOM];
    fram_status status = run_folder_make(p->o->output, error);
    if (status == FRAM_OK)
        status = write_panels(p, error);
    if (status == FRAM_OK)
        status = write_curve(p, error);
    if (status == FRAM_OK)
        status = write_zones(p, error);
    if (status == FRAM_OK)
        status = write_hull(p, error);
    if (status == FRAM_OK)
        status = write_for_page(p, error);
    if (status == FRAM_OK)
        status = path_own(p->o->output, "pressure.png", path, error);
    return status == FRAM_OK ? pressure_draw(p, path, error) : status;
}
