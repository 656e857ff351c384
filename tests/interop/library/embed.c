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
    simStartSimulation();
    for (int step = 0; step < 10; step++) check(simExtStep(1) == 1, "step");
    check(simGetSimulationTime() > 0.49f, "time");
    simExtPostExitRequest();
    check(simExtGetExitRequest() == 1, "exit");
    check(simExtSimThreadDestroy() == 1, "end");
    pthread_join(launch, NULL);
}

int main(int count, char** args) {
    root = count > 1 ? args[1] : ".";
    run();
    run();
    puts("ok");
    return 0;
}
