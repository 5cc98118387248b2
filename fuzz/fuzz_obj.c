/* mesh_file and hull_file on any bytes as Wavefront OBJ; see fuzzing_mesh.h for the promises. */
#include "fuzzing_mesh.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) { return fuzz_mesh(MESH_OBJ, data, size); }
