/* The version of Fram: the one place it is written.  The build reads it from here; the shared library's
   soname carries the major number. */
#ifndef FRAM_VERSION_H
#define FRAM_VERSION_H

#define FRAM_VERSION_MAJOR 0
#define FRAM_VERSION_MINOR 1
#define FRAM_VERSION_PATCH 0

#define FRAM_VERSION_TEXT_(x) #x
#define FRAM_VERSION_TEXT(major, minor, patch) \
    FRAM_VERSION_TEXT_(major) "." FRAM_VERSION_TEXT_(minor) "." FRAM_VERSION_TEXT_(patch)
/* "major.minor.patch" */
#define FRAM_VERSION FRAM_VERSION_TEXT(FRAM_VERSION_MAJOR, FRAM_VERSION_MINOR, FRAM_VERSION_PATCH)

#endif
