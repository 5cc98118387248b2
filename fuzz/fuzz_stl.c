/* mesh_file and hull_file on any bytes as STL, text or binary; see fuzzing_mesh.h for the promises. */
#include "fuzzing_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    return fuzz_mesh(size >= 5 && memcmp(data, "solid", 5) == 0 ? MESH_STL_TEXT : MESH_STL_BINARY, data, size);
}
