# The simulator as WebAssembly: bindings/wasm/simulator.c and the rooms it stands on, as one JavaScript file that holds
# its module; tools/wasm.sh makes the page of it.

add_executable(simulator bindings/wasm/simulator.c)
target_include_directories(simulator PRIVATE include)
target_link_libraries(simulator PRIVATE room_api)
set_target_properties(simulator PROPERTIES LINK_DEPENDS "${CMAKE_SOURCE_DIR}/bindings/wasm/library.js")
# Its functions are called from JavaScript, which reads no header.
target_compile_options(simulator PRIVATE -Wno-missing-prototypes)
# GEOS throws; a world of thousands of floes takes hundreds of megabytes; a failed allocation is an error of Fram.
target_link_options(simulator PRIVATE -O2 -fexceptions -sSINGLE_FILE=1 -sALLOW_MEMORY_GROWTH=1 -sMAXIMUM_MEMORY=4GB
    -sABORTING_MALLOC=0 -sMODULARIZE=1 -sEXPORT_NAME=FramSimulator -sENVIRONMENT=worker,node
    -sEXPORTED_RUNTIME_METHODS=ccall,FS -sFORCE_FILESYSTEM=1
    --js-library "${CMAKE_SOURCE_DIR}/bindings/wasm/library.js")
