/* Mirror images in the files of hulls, inside io: a file without those that it has on top of both halves.  Knows how
   readers of meshes order them; nothing of what is asked of a hull. */
#ifndef IO_HULL_MIRROR_H
#define IO_HULL_MIRROR_H

#include "io/hull_skin.h"
#include "io/mesh_file.h"

/* false: no memory; what `to` holds is to be freed even then. */
bool hull_copy_file(context *ctx, const mesh_file *from, mesh_file *to);
/* A copy of a file that is not mirrored in some of the planes in which it is.  As hull_copy_file. */
bool hull_unmirror(context *ctx, const mesh_file *file, hull_half planes, mesh_file *out);
/* Half a hull does not lie about its centre plane y = 0; half of a catamaran may be sound alone.  Along x hulls lie
   anywhere: about amidships of their length, of a waterline of theirs, or before a perpendicular. */
bool hull_lies_about_centre(const mesh *m);
/* One end is in x = 0: it may be the wall of half a hull. */
bool hull_begins_at_x(const mesh *m);

#endif
