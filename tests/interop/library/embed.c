/* A program in C on the library of CoppeliaSim 4.1: one thread waits in the launch, the main thread drives. */
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

int simExtLaunchUIThread(const char* name, int options, const char* scene, const char* root);
int simExtCanInitSimThread(void);
int simExtSimThreadInit(void);
int simExtSimThreadDestroy(void);
int simExtPostExitRequest(void);
int simExtGetExitRequest(void);
int simExtStep(unsigned char step_if_running);
int simStartSimulation(void);
int simCreateDummy(float size, const float* color);
int simSetObjectPosition(int object, int relative_to, const float* position);
int simGetObjectPosition(int object, int relative_to, float* position);
int simSetObjectName(int object, const char* name);
char* simGetObjectName(int object);
char* simGetLastError(void);
int simReleaseBuffer(const char* buffer);
float simGetSimulationTime(void);
int simHandleMill(int mill, float* removed);
int simRunSimulator(const char* name, int options, void (*init)(void), void (*loop)(void), void (*deinit)(void));
int simGetSimulationState(void);
int simHandleMainScript(void);
int simAdvanceSimulationByOneStep(void);

struct SScriptCallBack {
    int objectID, scriptID, stackID;
    char waitUntilZero;
    char* raiseErrorWithMessage;
};
int simRegisterScriptCallbackFunction(const char* name, const char* calltip, void (*callback)(struct SScriptCallBack*));
int simExecuteScriptString(int script, const char* text, int stack);
int simCreateStack(void);
int simReleaseStack(int stack);
int simPopStackItem(int stack, int count);
int simGetStackFloatValue(int stack, float* value);
int simPushFloatOntoStack(int stack, float value);
int simSetLastError(const char* function, const char* text);

static const char* root;

static void* wait_in_launch(void* nothing) {
    simExtLaunchUIThread("embed", 0, "", root);
    return nothing;
}

static void check(int holds, const char* what) {
    if (holds) return;
    char* error = simGetLastError();
    fprintf(stderr, "%s: %s\n", what, error);
    simReleaseBuffer(error);
    exit(1);
}

static void twice(struct SScriptCallBack* p) {
    float value = 0;
    simGetStackFloatValue(p->stackID, &value);
    simPopStackItem(p->stackID, 0);
    if (value < 0) simSetLastError("embed", "below zero");
    else simPushFloatOntoStack(p->stackID, 2 * value);
}

/* Functions of the program are globals of scripts, those that run already too. */
static void functions_for_scripts(void) {
    enum { SANDBOX = 8 };
    float value = 0;
    int stack = simCreateStack();
    check(simExecuteScriptString(SANDBOX, "simExtTwice(4)@", stack) == -1, "not there yet");
    check(simRegisterScriptCallbackFunction("simExtTwice@Embed", "number y=simExtTwice(number x)", twice) == 1, "new");
    check(simRegisterScriptCallbackFunction("simExtTwice@Embed", NULL, twice) == 0, "known");
    check(simRegisterScriptCallbackFunction("Embed.twice@Embed", NULL, twice) == 1, "in a table");
    check(simRegisterScriptCallbackFunction("none@Embed", NULL, NULL) == -1, "no function");
    check(simExecuteScriptString(SANDBOX, "simExtTwice(4) + Embed.twice(10)@", stack) == 0, "call");
    check(simGetStackFloatValue(stack, &value) == 1 && value == 28, "result");
    check(simExecuteScriptString(SANDBOX, "simExtTwice(-1)@", stack) == -1, "error");
    check(simReleaseStack(stack) == 1, "release");
}

static void run(void) {
    pthread_t launch;
    check(pthread_create(&launch, NULL, wait_in_launch, NULL) == 0, "thread");
    while (!simExtCanInitSimThread()) usleep(1000);
    check(simExtSimThreadInit() == 1, "init");
    int dummy = simCreateDummy(0.01f, NULL);
    float there[3] = {1.0f, 2.0f, 3.0f}, here[3] = {0};
    check(simSetObjectPosition(dummy, -1, there) == 1, "set");
    check(simGetObjectPosition(dummy, -1, here) == 1 && memcmp(here, there, sizeof here) == 0, "get");
    check(simSetObjectName(dummy, "Marker") == 1, "name");
    char* name = simGetObjectName(dummy);
    check(name && strcmp(name, "Marker") == 0 && simReleaseBuffer(name) == 1, "its name");
    check(simReleaseBuffer(name) == -1, "released twice");
    check(simHandleMill(1, here) == -1, "missing");
    functions_for_scripts();
    simStartSimulation();
    for (int step = 0; step < 10; step++) check(simExtStep(1) == 1, "step");
    check(simGetSimulationTime() > 0.49f, "time");
    simExtPostExitRequest();
    check(simExtGetExitRequest() == 1, "exit");
    check(simExtSimThreadDestroy() == 1, "end");
    pthread_join(launch, NULL);
}

/* The loop of programs for V-REP: the simulator calls them, on the thread that started it. */
static int begun, passes, ended;

static void begin(void) { begun += simStartSimulation() == 1; }

static void end(void) { ended++; }

static void pass(void) {
    check(begun == 1 && ended == 0, "order");
    int is_advancing = simGetSimulationState() & 16;
    if (is_advancing) check(simHandleMainScript() == 0 && simAdvanceSimulationByOneStep() == 1, "pass");
    if (++passes == 20) {
        check(simGetSimulationTime() > 0.89f && simGetSimulationTime() < 1.01f, "one step in each pass");
        check(simRunSimulator("embed", 0, NULL, NULL, NULL) == -1, "within a run");
        simExtPostExitRequest();
    }
}

int main(int count, char** args) {
    root = count > 1 ? args[1] : ".";
    run();
    run();
    check(simRunSimulator("embed", 0, begin, pass, end) == 1, "run");
    check(passes == 20 && ended == 1 && simGetSimulationState() == -1, "ended");
    puts("ok");
    return 0;
}
