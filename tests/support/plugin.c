/* A plugin for the tests. Its functions do what their names say; some of them do what a plugin must not do. */
#define SWANILDA_PLUGIN_IMPLEMENTATION
#include "swanilda_plugin.h"
#include <math.h>
#include <pthread.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static LIBRARY library;
static int messages[512];
static int phases[512];
static int destroyed = -1;

static void pop_all(SScriptCallBack* p) { simPopStackItem(p->stackID, 0); }

static void func(SScriptCallBack* p) {
    pop_all(p);
    simPushTextOntoStack(p->stackID, "Hello to you too!");
}

static void echo(SScriptCallBack* p) { (void)p; }

static void mixed(SScriptCallBack* p) {
    pop_all(p);
    simPushInt32OntoStack(p->stackID, 5);
    simPushDoubleOntoStack(p->stackID, 2.5);
    simPushStringOntoStack(p->stackID, "x", 0);
    simPushBoolOntoStack(p->stackID, true);
}

static void fail(SScriptCallBack* p) {
    (void)p;
    simSetLastError(NULL, "no good");
}

static void failInTheOldWay(SScriptCallBack* p) { strcpy(p->raiseErrorWithMessage, "no good either"); }

static void tableInfos(SScriptCallBack* p) {
    int infos[6];
    for (int i = 0; i < 6; i++) infos[i] = simGetStackTableInfo(p->stackID, i);
    pop_all(p);
    simPushInt32TableOntoStack(p->stackID, infos, 6);
}

static void unfold(SScriptCallBack* p) { simUnfoldStackTable(p->stackID); }

static void rotate(SScriptCallBack* p) { simMoveStackItemToTop(p->stackID, 0); }

static void readInt(SScriptCallBack* p) {
    int value = -99;
    int result = simGetStackInt32Value(p->stackID, &value);
    pop_all(p);
    simPushInt32OntoStack(p->stackID, result);
    simPushInt32OntoStack(p->stackID, value);
}

/* The sum of a list, and a table with lists and texts in it. */
static void tables(SScriptCallBack* p) {
    int count = simGetStackTableInfo(p->stackID, 0);
    double items[8] = {0}, sum = 0;
    simGetStackDoubleTable(p->stackID, items, count < 8 ? count : 8);
    for (int i = 0; i < 8; i++) sum += items[i];
    pop_all(p);
    simPushTableOntoStack(p->stackID);
    simPushTextOntoStack(p->stackID, "sum");
    simPushDoubleOntoStack(p->stackID, sum);
    simInsertDataIntoStackTable(p->stackID);
    simPushTextOntoStack(p->stackID, "bytes");
    simPushBufferOntoStack(p->stackID, "a\0b", 3);
    simInsertDataIntoStackTable(p->stackID);
    simPushTextOntoStack(p->stackID, "list");
    simPushTableOntoStack(p->stackID);
    for (int i = 1; i <= 3; i++) {
        simPushInt32OntoStack(p->stackID, i);
        simPushInt64OntoStack(p->stackID, 10LL * i);
        simInsertDataIntoStackTable(p->stackID);
    }
    simInsertDataIntoStackTable(p->stackID);
}

/* Gets the name of a function and its arguments. */
static void callScript(SScriptCallBack* p) {
    char name[64] = "";
    int length;
    simMoveStackItemToTop(p->stackID, 0);
    char* text = simGetStackStringValue(p->stackID, &length);
    if (text) {
        strncpy(name, text, sizeof name - 1);
        simReleaseBuffer(text);
    }
    simPopStackItem(p->stackID, 1);
    int result = simCallScriptFunctionEx(p->scriptID, name, p->stackID);
    simPushInt32OntoStack(p->stackID, result);
    simPushInt32OntoStack(p->stackID, simGetStackSize(p->stackID));
}

/* How often each message came, and of phases how often before and after. */
static void messageCounts(SScriptCallBack* p) {
    pop_all(p);
    simPushTableOntoStack(p->stackID);
    for (int id = 0; id < 512; id++) {
        if (!messages[id]) continue;
        simPushInt32OntoStack(p->stackID, id);
        simPushInt32OntoStack(p->stackID, messages[id]);
        simInsertDataIntoStackTable(p->stackID);
    }
    simPushInt32OntoStack(p->stackID, phases[341]);
    simPushInt32OntoStack(p->stackID, destroyed);
}

/* Moves an object by the interface, and reads where it is. */
static void moveObject(SScriptCallBack* p) {
    int handle = -1, count = 0;
    double position[3] = {1, 2, 3}, read[3] = {0}, matrix[12], velocity[3];
    simGetStackInt32Value(p->stackID, &handle);
    pop_all(p);
    int set = simSetObjectPosition(handle, -1, position);
    int got = simGetObjectPosition(handle, -1, read);
    char* alias = simGetObjectAlias(handle, -1);
    simPushInt32OntoStack(p->stackID, set + got);
    simPushDoubleTableOntoStack(p->stackID, read, 3);
    simPushTextOntoStack(p->stackID, alias);
    simReleaseBuffer(alias);
    int* objects = simGetObjectsInTree(-12, -2, 0, &count);
    simPushBoolOntoStack(p->stackID, objects && count > 0);
    simReleaseBuffer(objects);
    simGetObjectMatrix(handle, -1, matrix);
    simInvertMatrix(matrix);
    simPushDoubleOntoStack(p->stackID, matrix[3]);
    simPushInt32OntoStack(p->stackID, simGetObjectVelocity(handle, velocity, NULL));
    simPushInt32OntoStack(p->stackID, simGetObject("/noSuchThing", -1, -1, 1));
    simSetInt32Signal("fromPlugin", 7);
    int value = 0;
    simPushInt32OntoStack(p->stackID, simGetInt32Signal("fromPlugin", &value) + 10 * value);
    simPushInt32OntoStack(p->stackID, simGetInt32Signal("nobody", &value));
}

/* A shape and a vision sensor: what comes back by several pointers. */
static void manyResults(SScriptCallBack* p) {
    int handles[2], counts[4] = {0}, *indices = NULL, *packets = NULL;
    double *vertices = NULL, *normals = NULL, *values = NULL;
    int contact[2];
    bool known = true;
    double box[24];
    for (int i = 0; i < 24; i++) box[i] = (i / 3 >> i % 3) & 1;
    simGetStackInt32Table(p->stackID, handles, 2);
    pop_all(p);
    int s = p->stackID;
    simPushInt32OntoStack(s, simGetShapeMesh(handles[0], &vertices, counts, &indices, counts + 1, &normals));
    simPushDoubleTableOntoStack(s, vertices, counts[0]);
    simPushInt32TableOntoStack(s, indices, counts[1]);
    simPushDoubleTableOntoStack(s, normals, counts[1] * 3);
    simReleaseBuffer(vertices), simReleaseBuffer(indices), simReleaseBuffer(normals);
    simPushInt32OntoStack(s, simGetQHull(box, 24, &vertices, counts, &indices, counts + 1, 0, NULL));
    simPushInt32TableOntoStack(s, counts, 2);
    simReleaseBuffer(vertices), simReleaseBuffer(indices);
    simPushInt32OntoStack(s, simReadVisionSensor(handles[1], &values, &packets));
    simPushInt32TableOntoStack(s, packets, 2);
    simPushDoubleTableOntoStack(s, values, packets[1]);
    simReleaseBuffer(values), simReleaseBuffer(packets);
    simSetEngineFloatParam(sim_bullet_body_friction, handles[0], NULL, 0.25);
    simPushDoubleOntoStack(s, simGetEngineFloatParam(sim_bullet_body_friction, handles[0], NULL, &known));
    simPushBoolOntoStack(s, known);
    simGetEngineInt32Param(-77, handles[0], NULL, &known);
    simPushBoolOntoStack(s, known);
    simWriteCustomDataBlock(handles[0], "one", "1", 1);
    simWriteCustomDataBlock(handles[0], "two", "2", 1);
    char* names = simReadCustomDataBlockTags(handles[0], counts);
    simPushStringOntoStack(s, names, 8);
    simPushInt32OntoStack(s, counts[0]);
    simReleaseBuffer(names);
    simPushInt32OntoStack(s, simGetContactInfo(sim_handle_all, handles[0], 0, contact, box));
    simPushInt32OntoStack(s, simGetScriptHandleEx(sim_scripttype_customization, -1, "/nobody"));
}

static void version(SScriptCallBack* p) {
    int number = 0;
    pop_all(p);
    simPushInt32OntoStack(p->stackID, simGetIntProperty(-13, "productVersionNb", &number));
    simPushBoolOntoStack(p->stackID, number >= 4050107);
    simPushDoubleOntoStack(p->stackID, simGetSimulationTime());
}

/* What a plugin must not do: the result of each is a failure, and nothing else happens. */
static void misuse(SScriptCallBack* p) {
    int s = p->stackID, failures = 0, all = 0;
    double number;
    char local[4];
#define FAILS(call) (all++, failures += (call) == -1)
    pop_all(p);
    FAILS(simPushInt32OntoStack(12345, 1));
    FAILS(simPushInt32OntoStack(-1, 1));
    FAILS(simPushTextOntoStack(s, NULL));
    FAILS(simPushDoubleTableOntoStack(s, NULL, 3));
    FAILS(simPushDoubleTableOntoStack(s, &number, -3));
    FAILS(simPushDoubleTableOntoStack(s, &number, INT32_MAX));
    FAILS(simPopStackItem(s, 1000));
    FAILS(simPopStackItem(s, -1));
    FAILS(simGetStackDoubleValue(s, &number));
    FAILS(simInsertDataIntoStackTable(s));
    FAILS(simMoveStackItemToTop(s, 3));
    FAILS(simUnfoldStackTable(s));
    FAILS(simReleaseStack(77777));
    FAILS(simReleaseBuffer(local));
    FAILS(simReleaseBuffer(NULL));
    FAILS(simRegisterScriptCallbackFunction("x", NULL, NULL));
    FAILS(simRegisterScriptCallbackFunction(NULL, NULL, echo));
    FAILS(simCallScriptFunctionEx(987654 | 0x02000000, "f", s));
    FAILS(simCallScriptFunctionEx(p->scriptID, NULL, s));
    FAILS(simGetObjectPosition(-99, -1, NULL));
    FAILS(simSetObjectPosition(-99, -1, NULL));
    FAILS(simSetLastError(NULL, NULL));
    all++, failures += simCreateBuffer(-1) == NULL;
    all++, failures += simGetObjectAlias(-99, 0) == NULL;
    all++, failures += simGetStackStringValue(s, NULL) == NULL;
    simPushInt32OntoStack(s, all - failures);
    char* error = simGetLastError();
    simPushTextOntoStack(s, error);
    simReleaseBuffer(error);
}

/* A function that every plugin may look up and that is not built. */
static void missing(SScriptCallBack* p) {
    int (*function)(int) = NULL;
    *(void**)(&function) = dlsym(library, "simModifyPointCloud_D");
    pop_all(p);
    simPushInt32OntoStack(p->stackID, function(1) + function(2));
    char* error = simGetLastError();
    simPushTextOntoStack(p->stackID, error);
    simReleaseBuffer(error);
}

static void crash(SScriptCallBack* p) {
    (void)p;
    abort();
}

static void shout(SScriptCallBack* p) {
    pop_all(p);
    puts("written by the plugin itself");
    fflush(stdout);
}

static void* from_thread(void* result) {
    *(double*)result = simGetSimulationTime();
    return NULL;
}

static void fromThread(SScriptCallBack* p) {
    pthread_t thread;
    double result = 0;
    pop_all(p);
    pthread_create(&thread, NULL, from_thread, &result);
    pthread_join(thread, NULL);
    simPushDoubleOntoStack(p->stackID, result);
}

SIM_DLLEXPORT int simInit(SSimInit* info) {
    library = loadSimLibrary(info->coppeliaSimLibPath);
    if (!library || !getSimProcAddresses(library)) return 0;
    if (strcmp(info->pluginName, "simBad") == 0) {
        simSetLastError(NULL, "it is bad");
        return 0;
    }
    struct { const char* name; void (*function)(SScriptCallBack*); } functions[] = {
        {"func", func}, {"echo", echo}, {"mixed", mixed}, {"fail", fail}, {"failInTheOldWay", failInTheOldWay},
        {"tableInfos", tableInfos}, {"unfold", unfold}, {"rotate", rotate}, {"readInt", readInt}, {"tables", tables},
        {"callScript", callScript}, {"messageCounts", messageCounts}, {"moveObject", moveObject}, {"version", version},
        {"misuse", misuse}, {"missing", missing}, {"fromThread", fromThread}, {"crash", crash}, {"in.a.table", func}, {"shout", shout}, {"manyResults", manyResults},
    };
    for (size_t i = 0; i < sizeof functions / sizeof *functions; i++)
        if (simRegisterScriptCallbackFunction(functions[i].name, NULL, functions[i].function) != 1) return 0;
    if (simRegisterScriptCallbackFunction("func", NULL, func) != 0) return 0;
    simRegisterScriptVariable("E.a", "1 + 2", 0);
    int stack = simCreateStack();
    simPushTextOntoStack(stack, "from a stack");
    simRegisterScriptVariable("text", NULL, stack);
    simAddLog(info->pluginName, sim_verbosity_scriptinfos, "the plugin has started.");
    return 7;
}

SIM_DLLEXPORT void simCleanup(void) {
    simAddLog("simT", sim_verbosity_scriptinfos, "the plugin has ended.");
}

SIM_DLLEXPORT void simMsg(SSimMsg* message) {
    if (message->msgId < 0 || message->msgId >= 512) return;
    messages[message->msgId]++;
    if (message->msgId == 338) destroyed = message->auxData[0];
    phases[message->msgId] += message->auxData[0];
}
