// A plugin in C++, as the page on connectivity has it: a function that scripts call, and one that throws.
#define SWANILDA_PLUGIN_IMPLEMENTATION
#include "swanilda_plugin.h"
#include <stdexcept>
#include <string>

namespace {

void func(SScriptCallBack* p) {
    int size = 0;
    char* text = simGetStackStringValue(p->stackID, &size);
    std::string greeting = text ? std::string(text, size) : "";
    if (text) simReleaseBuffer(text);
    simPopStackItem(p->stackID, 0);
    simPushTextOntoStack(p->stackID, greeting == "Hello" ? "Hello to you too!" : "What?");
}

void caught(SScriptCallBack*) {
    try {
        throw std::runtime_error("caught at the edge");
    } catch (const std::exception& error) {
        simSetLastError(nullptr, error.what());
    }
}

void uncaught(SScriptCallBack*) { throw std::runtime_error("nobody catches this"); }

}  // namespace

SIM_DLLEXPORT int simInit(SSimInit* info) {
    LIBRARY library = loadSimLibrary(info->coppeliaSimLibPath);
    if (!library || !getSimProcAddresses(library)) return 0;
    simRegisterScriptCallbackFunction("func", nullptr, func);
    simRegisterScriptCallbackFunction("caught", nullptr, caught);
    simRegisterScriptCallbackFunction("uncaught", nullptr, uncaught);
    return 1;
}

SIM_DLLEXPORT void simCleanup() {}

SIM_DLLEXPORT void simMsg(SSimMsg*) {}
