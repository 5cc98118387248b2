// What the simulator's C calls and finds in the browser alone.
mergeInto(LibraryManager['library'], {
    simulator_tell_work: function (what, done, total) { Module['onWork'](UTF8ToString(what), done, total); },
    // Emscripten's C library declares it only.
    getrandom: function (to, size, flags) {
        crypto.getRandomValues(HEAPU8.subarray(to, to + size));
        return size;
    },
});
