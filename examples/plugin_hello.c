/*
 * A plugin for scenes/plugin_hello.lua:
 *
 *     cc -shared -fPIC -Iinclude -o scenes/libsimHello.so examples/plugin_hello.c
 */
#define SWANILDA_PLUGIN_IMPLEMENTATION
#include "swanilda_plugin.h"
#include <string.h>

static LIBRARY library;

/* simHello.func(text): an answer to a greeting. */
static void func(SScriptCallBack* call) {
    int length = 0;
    char* text = simGetStackStringValue(call->stackID, &length);
    int is_greeting = text && strcmp(text, "Hello") == 0;
    if (text) simReleaseBuffer(text);
    simPopStackItem(call->stackID, 0);
    simPushTextOntoStack(call->stackID, is_greeting ? "Hello to you too!" : "What do you mean?");
}

/* simHello.height(handle): how high an object is. */
static void height(SScriptCallBack* call) {
    int handle = -1;
    double position[3];
    if (simGetStackInt32Value(call->stackID, &handle) != 1 || simGetObjectPosition(handle, -1, position) == -1) {
        simSetLastError(NULL, "the handle of an object is needed.");
        return;
    }
    simPopStackItem(call->stackID, 0);
    simPushDoubleOntoStack(call->stackID, position[2]);
}

SIM_DLLEXPORT int simInit(SSimInit* info) {
    library = loadSimLibrary(info->coppeliaSimLibPath);
    if (!library || !getSimProcAddresses(library)) return 0;
    simRegisterScriptCallbackFunction("func", NULL, func);
    simRegisterScriptCallbackFunction("height", NULL, height);
    simRegisterScriptVariable("language", "'C'", 0);
    return 1;
}

SIM_DLLEXPORT void simCleanup(void) {}

SIM_DLLEXPORT void simMsg(SSimMsg* message) { (void)message; }
