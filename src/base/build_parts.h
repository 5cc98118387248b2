/* What this build of Fram is made of, as text for `fram --version` and for the run folder.  The build
   system defines FRAM_HAVE_<PART>="version" for every library it found; code that needs an optional part
   stands in #ifdef FRAM_HAVE_<PART> and otherwise answers FRAM_ERROR_UNSUPPORTED. */
#ifndef BASE_BUILD_PARTS_H
#define BASE_BUILD_PARTS_H

/* "geos 3.11.1, libfyaml 0.7.12, ...", in alphabetical order; "none" when nothing was found. */
const char *build_parts(void);
/* The compiler, "gcc 12.2.0" or "clang 14.0.6". */
const char *build_compiler(void);

#endif
