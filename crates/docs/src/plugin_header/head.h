/*
 * Generated: UPDATE=1 cargo test --test repository generated.
 *
 * The C interface of native plugins for CoppeliaSim, as far as Swanilda has it: types, constants and functions. A plugin that was compiled
 * with CoppeliaSim's own headers runs as well; this one needs nothing else.
 *
 * One source file of the plugin defines SWANILDA_PLUGIN_IMPLEMENTATION before it includes this file. It exports simInit, which calls
 *     loadSimLibrary(info->coppeliaSimLibPath) and getSimProcAddresses(library)
 * before any other function, registers functions for scripts, and returns the version of the plugin, or 0 if it cannot run.
 *
 * Functions return -1, or NULL, if they fail; simGetLastError says why. Texts and arrays that they return are released with
 * simReleaseBuffer. Call them from the functions that the simulator calls only, never from threads of your own.
 * Handles are those of scripts; lengths are metres, angles radians, times seconds.
 */
#ifndef SWANILDA_PLUGIN_H
#define SWANILDA_PLUGIN_H

#include <stddef.h>
#ifndef __cplusplus
#include <stdbool.h>
#endif

#ifdef __cplusplus
#define SIM_DLLEXPORT extern "C" __attribute__((visibility("default")))
extern "C" {
#else
#define SIM_DLLEXPORT __attribute__((visibility("default")))
#endif

/* What simInit gets. */
typedef struct SSimInit {
    const char* pluginName;
    const char* coppeliaSimLibPath;
} SSimInit;

/* What simMsg gets: the kind of message, and numbers that belong to it. */
typedef struct SSimMsg {
    int msgId;
    int* auxData;
    void* auxPointer;
} SSimMsg;

/* What a function for scripts gets. Its arguments are on the stack; what is there when it returns are its results. */
typedef struct SScriptCallBack {
    int objectID;
    int scriptID;
    int stackID;
    char waitUntilZero;
    char* raiseErrorWithMessage;
    char* source;
    int line;
} SScriptCallBack;

/* Messages. */
enum {
    sim_message_eventcallback_scenesave = 260,
    sim_message_eventcallback_modelsave = 261,
    sim_message_eventcallback_instancepass = 269,
    sim_message_eventcallback_simulationabouttostart = 285,
    sim_message_eventcallback_simulationended = 286,
    sim_message_eventcallback_sceneloaded = 294,
    sim_message_eventcallback_modelloaded = 295,
    sim_message_eventcallback_simulationabouttoend = 334,
    sim_message_eventcallback_scriptstateabouttobedestroyed = 338,
    sim_message_eventcallback_simulationinit = 340,
    sim_message_eventcallback_simulationactuation = 341,
    sim_message_eventcallback_simulationsensing = 342,
    sim_message_eventcallback_simulationcleanup = 343
};

/* What simGetStackTableInfo returns for what is no list. */
enum { sim_stack_table_map = -2, sim_stack_table_not_table = -3 };

