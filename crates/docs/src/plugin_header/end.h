#define SWANILDA_DECLARE(result, name, symbol, parameters) extern result (*name) parameters;
SWANILDA_FUNCTIONS(SWANILDA_DECLARE)

typedef void* LIBRARY;

/* Opens the library that simInit got the path of; NULL if that fails. */
LIBRARY loadSimLibrary(const char* path);
/* Finds all functions: 1, or 0 if one is missing and the environment has no COPPELIASIMPLUGIN_IGNORE_MISSING_SYMBOLS. */
int getSimProcAddresses(LIBRARY library);
void unloadSimLibrary(LIBRARY library);

#ifdef SWANILDA_PLUGIN_IMPLEMENTATION
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>

#define SWANILDA_DEFINE(result, name, symbol, parameters) result (*name) parameters = NULL;
SWANILDA_FUNCTIONS(SWANILDA_DEFINE)

LIBRARY loadSimLibrary(const char* path) { return dlopen(path, RTLD_LAZY); }

void unloadSimLibrary(LIBRARY library) {
    if (library) dlclose(library);
}

int getSimProcAddresses(LIBRARY library) {
    int complete = 1;
#define SWANILDA_FIND(result, name, symbol, parameters) \
    *(void**)(&name) = dlsym(library, symbol); \
    if (!name) { \
        fprintf(stderr, "Could not find function %s\n", symbol); \
        complete = 0; \
    }
    SWANILDA_FUNCTIONS(SWANILDA_FIND)
    return complete || getenv("COPPELIASIMPLUGIN_IGNORE_MISSING_SYMBOLS") != NULL;
}
#endif

#ifdef __cplusplus
}
#endif
#endif
