# Read by the build of GEOS for WebAssembly (tools/wasm_libraries.sh): what most of its files include, compiled
# once; that takes a third off the build and changes none of its objects.
cmake_language(DEFER CALL target_precompile_headers geos PRIVATE
    <algorithm> <array> <cassert> <cmath> <deque> <functional> <iomanip> <iostream> <limits> <list> <map> <memory>
    <queue> <set> <sstream> <stack> <string> <unordered_map> <unordered_set> <utility> <vector>
    <geos/geom/GeometryFactory.h> <geos/geom/Polygon.h> <geos/geom/MultiPolygon.h> <geos/geom/LineString.h>
    <geos/geom/Point.h> <geos/geom/LinearRing.h> <geos/geom/CoordinateSequence.h>
    <geos/geom/CoordinateArraySequence.h> <geos/util/IllegalArgumentException.h>)
