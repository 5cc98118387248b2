/* What this build is made of; see build.h. */
#include "base/build_parts.h"

/* Each part is ", name version" when it is in, so that a list begins at its third character. */
#ifdef FRAM_HAVE_CAIRO
#define PART_CAIRO ", cairo " FRAM_HAVE_CAIRO
#else
#define PART_CAIRO ""
#endif
#ifdef FRAM_HAVE_GEOS
#define PART_GEOS ", geos " FRAM_HAVE_GEOS
#else
#define PART_GEOS ""
#endif
#ifdef FRAM_HAVE_LIBFYAML
#define PART_LIBFYAML ", libfyaml " FRAM_HAVE_LIBFYAML
#else
#define PART_LIBFYAML ""
#endif
#ifdef FRAM_HAVE_LIBMICROHTTPD
#define PART_LIBMICROHTTPD ", libmicrohttpd " FRAM_HAVE_LIBMICROHTTPD
#else
#define PART_LIBMICROHTTPD ""
#endif
#ifdef FRAM_HAVE_LIBPNG
#define PART_LIBPNG ", libpng " FRAM_HAVE_LIBPNG
#else
#define PART_LIBPNG ""
#endif
#ifdef FRAM_HAVE_NETCDF
#define PART_NETCDF ", netcdf " FRAM_HAVE_NETCDF
#else
#define PART_NETCDF ""
#endif
#ifdef FRAM_HAVE_NETTLE
#define PART_NETTLE ", nettle " FRAM_HAVE_NETTLE
#else
#define PART_NETTLE ""
#endif
#ifdef FRAM_HAVE_ZLIB
#define PART_ZLIB ", zlib " FRAM_HAVE_ZLIB
#else
#define PART_ZLIB ""
#endif

static const char parts[] =
    PART_CAIRO PART_GEOS PART_LIBFYAML PART_LIBMICROHTTPD PART_LIBPNG PART_NETCDF PART_NETTLE PART_ZLIB;

const char *build_parts(void) { return sizeof parts > 2 ? parts + 2 : "none"; }

const char *build_compiler(void)
{
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "gcc " __VERSION__;
#else
    return "unknown compiler";
#endif
}
