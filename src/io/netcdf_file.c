#include "io/netcdf_file.h"

#include "io/atomic_file.h"
#include "io/temporary.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifdef FRAM_HAVE_NETCDF
#include <dlfcn.h>
#include <netcdf.h>
#include <netcdf_mem.h>

/* NetCDF brings sixty libraries, which take longer to load than most commands run: it is opened when the first file
   is written, and stays open. */
#define CALLS(X)        \
    X(create)           \
    X(create_mem)       \
    X(close)            \
    X(close_memio)      \
    X(def_dim)          \
    X(def_var)          \
    X(def_var_chunking) \
    X(def_var_deflate)  \
    X(inq_dimlen)       \
    X(put_att_text)     \
    X(put_var_double)   \
    X(put_var_int)      \
    X(put_var_string)   \
    X(put_vara_double)  \
    X(strerror)
#define POINTER(name) __typeof__(nc_##name) *name;
struct netcdf_calls {
    CALLS(POINTER)
};

/* call: a pointer to the function, of whatever type. */
static bool find(void *library, const char *name, void *call)
{
    void *found = dlsym(library, name);
    memcpy(call, &found, sizeof found); /* the size of all pointers in POSIX */
    return found != NULL;
}

static bool find_all(netcdf_calls *nc)
{
    void *library = dlopen(FRAM_NETCDF_LIBRARY, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
#define AND_FOUND(name) &&find(library, "nc_" #name, &nc->name)
    return library != NULL CALLS(AND_FOUND);
}

static fram_status open_library(context *ctx, const char *path, netcdf_calls **out, fram_error *error)
{
    *out = memory_array(ctx, 1, sizeof **out);
    if (!*out)
        return error_memory(error);
    if (find_all(*out))
        return FRAM_OK;
    memory_free(ctx, *out);
    *out = NULL;
    (void)error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL,
                    "a .nc file is written by the NetCDF library (Debian: libnetcdf-dev), which does not open: %s",
                    dlerror());
    return FRAM_ERROR_UNSUPPORTED; /* in so many words: who analyses callers sees that the library is there if not */
}

/* Shuffled and deflated at level 1: columns of slow change shrink to a third, and writing stays bound by the disk. */
enum { SHUFFLE = 1, DEFLATE = 1, LEVEL = 1 };
/* Values of a chunk of two dimensions at least: every chunk costs 600 bytes and a write of its own. */
enum { CHUNK_VALUES = 1024 };
/* What a file in memory begins with; HDF5 lets it grow by as much and more. */
enum { MEMORY_BYTES = 1 << 16 };

static void keep(netcdf_file *f, int code)
{
    if (code != NC_NOERR && f->failed == NC_NOERR)
        f->failed = code;
}

static void forget_netcdf(netcdf_file *f)
{
    memory_free(f->ctx, f->nc);
    memory_free(f->ctx, f->path);
    memory_free(f->ctx, f->temporary);
    memset(f, 0, sizeof *f);
}

static fram_status prepare(context *ctx, const char *path, netcdf_file *f, fram_error *error)
{
    memset(f, 0, sizeof *f);
    fram_status status = open_library(ctx, path, &f->nc, error);
    if (status != FRAM_OK)
        return status;
    f->ctx = ctx;
    f->path = memory_string(ctx, path);
    if (f->path)
        return FRAM_OK;
    forget_netcdf(f);
    return error_memory(error);
}

fram_status netcdf_begin_in_memory(context *ctx, const char *path, netcdf_file *f, fram_error *error)
{
    fram_status status = prepare(ctx, path, f, error);
    if (status != FRAM_OK)
        return status;
    int code = f->nc->create_mem(f->path, NC_NETCDF4 | NC_CLOBBER, MEMORY_BYTES, &f->id);
    if (code != NC_NOERR) {
        status = error_set(error, FRAM_ERROR_IO, path, 0, NULL, "cannot write: %s", f->nc->strerror(code));
        forget_netcdf(f);
        return status;
    }
    f->open = true;
    return FRAM_OK;
}

/* NetCDF takes a name, and reads it as one of any system: a backslash as a slash, "C:" as a drive.  So it is given that
   of the open descriptor, where the system has such names. */
static int create_named(netcdf_file *f, int descriptor)
{
    char name[32];
    snprintf(name, sizeof name, "/proc/self/fd/%d", descriptor);
    return f->nc->create(access(name, F_OK) == 0 ? name : f->temporary, NC_NETCDF4 | NC_CLOBBER, &f->id);
}

/* That NetCDF says "permission denied" for whatever HDF5 met in a file that could be made misleads: what the system
   says of a first block is the reason. */
static fram_status refuse_beginning(const netcdf_file *f, int code, int descriptor, fram_error *error)
{
    static const char block[4096];
    ssize_t put = pwrite(descriptor, block, sizeof block, 0);
    if (put != (ssize_t)sizeof block)
        return file_error(error, f->path, "write the beginning of the file", put < 0 ? errno : ENOSPC);
    return error_set(error, FRAM_ERROR_IO, f->path, 0, NULL, "cannot write: NetCDF does not begin the file%s%s",
                     code == EACCES ? "" : ": ", code == EACCES ? "" : f->nc->strerror(code));
}

fram_status netcdf_begin(context *ctx, const char *path, netcdf_file *f, fram_error *error)
{
    int descriptor = -1;
    fram_status status = prepare(ctx, path, f, error);
    if (status != FRAM_OK)
        return status;
    status = atomic_file_check(path, error); /* as it is asked again when all is written */
    if (status == FRAM_OK)
        status = temporary_file(ctx, path, &f->temporary, &descriptor, error);
    if (status == FRAM_OK) {
        int code = create_named(f, descriptor);
        f->open = code == NC_NOERR;
        if (!f->open) {
            status = refuse_beginning(f, code, descriptor, error);
            unlink(f->temporary);
        }
        close(descriptor);
    }
    if (status != FRAM_OK)
        forget_netcdf(f);
    return status;
}

int netcdf_dimension(netcdf_file *f, const char *name, size_t length)
{
    int dimension = 0;
    if (!f->failed)
        keep(f, f->nc->def_dim(f->id, name, length, &dimension));
    return dimension;
}

static void put_text(netcdf_file *f, int variable, const char *name, const char *text)
{
    if (!f->failed && *text)
        keep(f, f->nc->put_att_text(f->id, variable, name, strlen(text), text));
}

int netcdf_variable(netcdf_file *f, const char *name, netcdf_type type, const int *dimensions, int count,
                    const char *units, const char *meaning)
{
    static const nc_type types[] = {
        [NETCDF_F64] = NC_DOUBLE, [NETCDF_F32] = NC_FLOAT, [NETCDF_I32] = NC_INT, [NETCDF_TEXT] = NC_STRING};
    int variable = 0;
    if (f->failed)
        return variable;
    keep(f, f->nc->def_var(f->id, name, types[type], count, dimensions, &variable));
    size_t length = 0, rows = 0;
    if (!f->failed && count > 0 && type != NETCDF_TEXT) {
        keep(f, f->nc->inq_dimlen(f->id, dimensions[count - 1], &length));
        keep(f, f->nc->def_var_deflate(f->id, variable, SHUFFLE, DEFLATE, LEVEL));
    }
    if (!f->failed && count == 2) {
        keep(f, f->nc->inq_dimlen(f->id, dimensions[0], &rows));
        size_t wanted = length > 0 ? (CHUNK_VALUES + length - 1) / length : 1;
        const size_t chunk[2] = {wanted < rows ? wanted : rows > 0 ? rows : 1, length > 0 ? length : 1};
        keep(f, f->nc->def_var_chunking(f->id, variable, NC_CHUNKED, chunk));
    }
    put_text(f, variable, "units", units);
    put_text(f, variable, "long_name", meaning);
    return variable;
}

void netcdf_attribute(netcdf_file *f, const char *name, const char *text) { put_text(f, NC_GLOBAL, name, text); }

void netcdf_put_f64(netcdf_file *f, int variable, const double *values)
{
    if (!f->failed)
        keep(f, f->nc->put_var_double(f->id, variable, values));
}

void netcdf_put_i32(netcdf_file *f, int variable, const int32_t *values)
{
    if (!f->failed)
        keep(f, f->nc->put_var_int(f->id, variable, values));
}

void netcdf_put_text(netcdf_file *f, int variable, const char **values)
{
    if (!f->failed)
        keep(f, f->nc->put_var_string(f->id, variable, values));
}

void netcdf_put_row(netcdf_file *f, int variable, size_t row, const double *values, size_t count)
{
    const size_t start[2] = {row, 0}, edge[2] = {1, count};
    if (!f->failed && count > 0)
        keep(f, f->nc->put_vara_double(f->id, variable, start, edge, values));
}

/* Gives the whole file its name. */
static fram_status put_in_place(netcdf_file *f, const NC_memio *whole, fram_error *error)
{
    if (f->failed == NC_NOERR)
        return f->temporary ? atomic_file_adopt(f->ctx, f->temporary, f->path, error)
                            : atomic_file_write(f->ctx, f->path, whole->memory, whole->size, error);
    if (f->temporary)
        unlink(f->temporary);
    /* HDF5 keeps to itself what it met, which is mostly that there is no room. */
    return error_set(error, FRAM_ERROR_IO, f->path, 0, NULL, "cannot write: %s%s", f->nc->strerror(f->failed),
                     f->temporary && f->failed == NC_EHDFERR ? " (a full disk ends so)" : "");
}

fram_status netcdf_end(netcdf_file *f, fram_error *error)
{
    NC_memio whole = {.memory = NULL};
    keep(f, f->temporary ? f->nc->close(f->id) : f->nc->close_memio(f->id, &whole));
    f->open = false;
    fram_status status = put_in_place(f, &whole, error);
    free(whole.memory); /* of the library, which takes it from malloc */
    forget_netcdf(f);
    return status;
}

void netcdf_abandon(netcdf_file *f)
{
    if (!f->open)
        return;
    f->nc->close(f->id);
    if (f->temporary)
        unlink(f->temporary);
    forget_netcdf(f);
}

#else

fram_status netcdf_begin(context *ctx, const char *path, netcdf_file *f, fram_error *error)
{
    (void)ctx;
    memset(f, 0, sizeof *f);
    return error_set(error, FRAM_ERROR_UNSUPPORTED, path, 0, NULL,
                     "this build has no NetCDF (Debian: libnetcdf-dev), so it writes no .nc files");
}
fram_status netcdf_begin_in_memory(context *ctx, const char *path, netcdf_file *f, fram_error *error)
{
    return netcdf_begin(ctx, path, f, error);
}
int netcdf_dimension(netcdf_file *f, const char *name, size_t length) { return (void)f, (void)name, (int)length; }
int netcdf_variable(netcdf_file *f, const char *name, netcdf_type type, const int *dimensions, int count,
                    const char *units, const char *meaning)
{
    return (void)f, (void)name, (void)type, (void)dimensions, (void)units, (void)meaning, count;
}
void netcdf_attribute(netcdf_file *f, const char *name, const char *text) { (void)f, (void)name, (void)text; }
void netcdf_put_f64(netcdf_file *f, int variable, const double *values) { (void)f, (void)variable, (void)values; }
void netcdf_put_i32(netcdf_file *f, int variable, const int32_t *values) { (void)f, (void)variable, (void)values; }
void netcdf_put_text(netcdf_file *f, int variable, const char **values) { (void)f, (void)variable, (void)values; }
void netcdf_put_row(netcdf_file *f, int variable, size_t row, const double *values, size_t count)
{
    (void)f, (void)variable, (void)row, (void)values, (void)count;
}
fram_status netcdf_end(netcdf_file *f, fram_error *error)
{
    (void)f;
    return error_set(error, FRAM_ERROR_UNSUPPORTED, NULL, 0, NULL, "this build has no NetCDF");
}
void netcdf_abandon(netcdf_file *f) { (void)f; }

#endif
