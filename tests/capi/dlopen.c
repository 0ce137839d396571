/* SPDX-License-Identifier: BSD-3-Clause
 *
 * A host that loads the library at run time: load, use, unload without shutting down, three times;
 * then once with, after which a freshly loaded library says that it is over.
 * Usage: dlopen <path of libconnectivity.so>. Exit status 0, or the number of what failed. */
#include <dlfcn.h>
#include <string.h>

#include <connectivity.h>

typedef struct library {
    void* handle;
    conn_status (*context_create)(const conn_context_options*, conn_context**);
    conn_status (*context_destroy)(conn_context**);
    conn_status (*context_threads)(const conn_context*, int32_t*);
    conn_status (*shutdown)(void);
} library;

/* Function pointers come as void*, which C does not convert; POSIX says the bytes are right. */
static int find(void* handle, const char* name, void* function) {
    void* symbol = dlsym(handle, name);
    memcpy(function, &symbol, sizeof symbol);
    return symbol != NULL;
}

static int load(library* lib, const char* path) {
    lib->handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    return lib->handle != NULL && find(lib->handle, "conn_context_create", &lib->context_create) &&
           find(lib->handle, "conn_context_destroy", &lib->context_destroy) &&
           find(lib->handle, "conn_context_threads", &lib->context_threads) &&
           find(lib->handle, "conn_shutdown", &lib->shutdown);
}

int main(int argc, char** argv) {
    library lib;
    conn_context* context = NULL;
    int32_t n_threads = 0;
    if (argc != 2) return 1;
    for (int cycle = 0; cycle < 4; ++cycle) {
        conn_context_options options = CONN_CONTEXT_OPTIONS_INIT;
        options.n_threads = 2;
        if (!load(&lib, argv[1])) return 2;
        if (lib.context_create(&options, &context) != CONN_OK) return 3;
        if (lib.context_threads(context, &n_threads) != CONN_OK || n_threads != 2) return 4;
        if (lib.context_destroy(&context) != CONN_OK) return 5;
        if (cycle == 3 && lib.shutdown() != CONN_OK) return 6;
        dlclose(lib.handle);
    }
    if (!load(&lib, argv[1])) return 7;
    if (lib.context_create(NULL, &context) != CONN_E_FINALIZED) return 8;
    return dlclose(lib.handle) == 0 ? 0 : 9;
}
