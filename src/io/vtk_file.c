/* VTK XML: a head that names the arrays and where in the appended part they begin, then the arrays.  Each array is one
   compressed block behind four numbers: 1 (blocks), its size, 0 (no partial block), its compressed size; an array
   without content is two zeros and no block. */
#include "io/vtk_file.h"

#include "io/atomic_file.h"
#include "io/text_buffer.h"

#include <string.h>
#include <zlib.h>

/* Level 1 costs a third of the default's time and a tenth more of disk. */
enum { ARRAY_COMPRESSION = 1 };

typedef struct vtk_writer {
    context *ctx;
    text_buffer head;
    ARRAY(unsigned char) appended;
    z_stream packer; /* one for all arrays: it takes a quarter of a megabyte, which is cleared when it is made */
    bool failed;     /* no memory */
} vtk_writer;

static void append_bytes(vtk_writer *w, const void *data, size_t size)
{
    int32_t at = w->appended.count;
    if (w->failed || size > (size_t)(INT32_MAX - at) || !array_resize(w->ctx, &w->appended, at + (int32_t)size))
        w->failed = true;
    else if (size > 0)
        memcpy(w->appended.data + at, data, size);
}

/* Packs behind what is there; returns the size, 0: no memory. */
static uint64_t pack_array(vtk_writer *w, const void *data, size_t size)
{
    uLong room = compressBound((uLong)size);
    int32_t at = w->appended.count;
    if (w->failed || size > UINT32_MAX || room > (uLong)(INT32_MAX - at) ||
        !array_reserve(w->ctx, &w->appended, at + (int32_t)room) || deflateReset(&w->packer) != Z_OK)
        return 0;
    w->packer.next_in = (z_const Bytef *)data;
    w->packer.avail_in = (uInt)size;
    w->packer.next_out = w->appended.data + at;
    w->packer.avail_out = (uInt)room;
    if (deflate(&w->packer, Z_FINISH) != Z_STREAM_END)
        return 0;
    w->appended.count = at + (int32_t)w->packer.total_out;
    return w->packer.total_out;
}

static void append_array(vtk_writer *w, const void *data, size_t size)
{
    int32_t at = w->appended.count;
    uint64_t prefix[4] = {1, size, 0, 0};
    if (size == 0) {
        const uint64_t none[3] = {0};
        append_bytes(w, none, sizeof none);
        return;
    }
    append_bytes(w, prefix, sizeof prefix);
    prefix[3] = pack_array(w, data, size);
    if (prefix[3] == 0)
        w->failed = true;
    else
        memcpy(w->appended.data + at, prefix, sizeof prefix);
}

static void add_array(vtk_writer *w, const char *type, const char *name, int components, const void *data, size_t size)
{
    text_format(w->ctx, &w->head,
                "<DataArray type=\"%s\" Name=\"%s\" NumberOfComponents=\"%d\" format=\"appended\" offset=\"%d\"/>\n",
                type, name, components, (int)w->appended.count);
    append_array(w, data, size);
}

static void add_cells(vtk_writer *w, const char *element, const vtk_data *d, bool present)
{
    int32_t cells = present ? d->cell_count : 0, ends = cells > 0 ? d->offset[cells - 1] : 0;
    text_format(w->ctx, &w->head, "<%s>\n", element);
    add_array(w, "Int32", "connectivity", 1, d->connectivity, (size_t)ends * sizeof *d->connectivity);
    add_array(w, "Int32", "offsets", 1, d->offset, (size_t)cells * sizeof *d->offset);
    text_format(w->ctx, &w->head, "</%s>\n", element);
}

static const char *byte_order(void)
{
    const uint16_t one = 1;
    unsigned char first;
    memcpy(&first, &one, 1);
    return first ? "LittleEndian" : "BigEndian";
}

static void compose(vtk_writer *w, const vtk_data *d)
{
    context *ctx = w->ctx;
    text_buffer *head = &w->head;
    text_format(ctx, head,
                "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"%s\" "
                "header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<PolyData>\n<FieldData>\n<DataArray "
                "type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">%.17g</DataArray>\n"
                "</FieldData>\n",
                byte_order(), d->time);
    text_format(ctx, head,
                "<Piece NumberOfPoints=\"%d\" NumberOfVerts=\"%d\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                "NumberOfPolys=\"%d\">\n<CellData>\n",
                (int)d->point_count, d->kind == VTK_VERTICES ? (int)d->cell_count : 0,
                d->kind == VTK_POLYGONS ? (int)d->cell_count : 0);
    for (int32_t i = 0; i < d->field_count; i++) {
        const vtk_field *f = &d->fields[i];
        add_array(w, "Float32", f->name, f->components, f->value,
                  (size_t)d->cell_count * (size_t)f->components * sizeof *f->value);
    }
    text_add(ctx, head, "</CellData>\n<Points>\n");
    _Static_assert(sizeof(vec3) == 3 * sizeof(double), "points are packed");
    add_array(w, "Float64", "Points", 3, d->point, (size_t)d->point_count * sizeof *d->point);
    text_add(ctx, head, "</Points>\n");
    add_cells(w, "Verts", d, d->kind == VTK_VERTICES);
    add_cells(w, "Polys", d, d->kind == VTK_POLYGONS);
    text_add(ctx, head, "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_");
}

static fram_status write_parts(vtk_writer *w, atomic_file *file, fram_error *error)
{
    static const char tail[] = "\n</AppendedData>\n</VTKFile>\n";
    fram_status status = file_write(&file->writer, w->head.data, (size_t)w->head.count, error);
    if (status == FRAM_OK)
        status = file_write(&file->writer, w->appended.data, (size_t)w->appended.count, error);
    return status == FRAM_OK ? file_write(&file->writer, tail, sizeof tail - 1, error) : status;
}

fram_status vtk_write(context *ctx, const char *path, const vtk_data *data, fram_error *error)
{
    vtk_writer w = {.ctx = ctx};
    atomic_file file;
    if (deflateInit(&w.packer, ARRAY_COMPRESSION) != Z_OK)
        return error_memory(error);
    compose(&w, data);
    deflateEnd(&w.packer);
    fram_status status = w.failed || w.head.failed ? error_memory(error) : atomic_file_begin(ctx, path, &file, error);
    if (status == FRAM_OK) {
        status = write_parts(&w, &file, error);
        if (status == FRAM_OK)
            status = atomic_file_place(&file, error);
        else
            atomic_file_abandon(&file);
    }
    text_free(ctx, &w.head);
    array_free(ctx, &w.appended);
    return status;
}

fram_status vtk_series_write(context *ctx, const char *path, const vtk_step *steps, int32_t count, fram_error *error)
{
    text_buffer b = {0};
    text_format(ctx, &b, "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"%s\">\n",
                byte_order());
    text_add(ctx, &b, "<Collection>\n");
    for (int32_t i = 0; i < count; i++)
        text_format(ctx, &b, "<DataSet timestep=\"%.17g\" group=\"\" part=\"%d\" file=\"%s\"/>\n", steps[i].time,
                    (int)steps[i].part, steps[i].name);
    text_add(ctx, &b, "</Collection>\n</VTKFile>\n");
    fram_status status = text_file_write(ctx, path, &b, error);
    text_free(ctx, &b);
    return status;
}
