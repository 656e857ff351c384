/*
 * Generated: UPDATE=1 cargo test --test generated.
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

/* Types of the items of stacks. */
enum {
    sim_stackitem_null = 0,
    sim_stackitem_double = 1,
    sim_stackitem_bool = 2,
    sim_stackitem_string = 3,
    sim_stackitem_table = 4,
    sim_stackitem_integer = 9
};

/* What simGetStackTableInfo returns for what is no list. */
enum { sim_stack_table_map = -2, sim_stack_table_not_table = -3 };

/* Levels of simAddLog. */
enum {
    sim_verbosity_errors = 200,
    sim_verbosity_warnings = 300,
    sim_verbosity_scripterrors = 420,
    sim_verbosity_scriptwarnings = 430,
    sim_verbosity_scriptinfos = 450,
    sim_verbosity_infos = 500
};

/* X(result, name, symbol, parameters) for every function. A parameter n... is the number of values of the one before it. */
#define SWANILDA_FUNCTIONS(X) \
    X(int, simAddLog, "simAddLog", (const char* a, int b, const char* c)) \
    X(int, simSetLastError, "simSetLastError", (const char* a, const char* b)) \
    X(char*, simGetLastError, "simGetLastError", (void)) \
    X(void*, simCreateBuffer, "simCreateBuffer", (int a)) \
    X(int, simReleaseBuffer, "simReleaseBuffer", (const void* a)) \
    X(int, simRegisterScriptCallbackFunction, "simRegisterScriptCallbackFunction", (const char* a, const char* b, void (*c)(struct SScriptCallBack*))) \
    X(int, simRegisterScriptVariable, "simRegisterScriptVariable", (const char* a, const char* b, int c)) \
    X(int, simSetPluginInfo, "simSetPluginInfo", (const char* a, int b, const char* c, int d)) \
    X(int, simGetPluginInfo, "simGetPluginInfo", (const char* a, int b, char** c, int* d)) \
    X(int, simCallMethod, "simCallMethod", (long long int a, const char* b, int c, int d, int e)) \
    X(int, simCallScriptFunctionEx, "simCallScriptFunctionEx", (int a, const char* b, int c)) \
    X(int, simExecuteScriptString, "simExecuteScriptString", (int a, const char* b, int c)) \
    X(int, simCreateStack, "simCreateStack", (void)) \
    X(int, simReleaseStack, "simReleaseStack", (int a)) \
    X(int, simCopyStack, "simCopyStack", (int a)) \
    X(int, simPushNullOntoStack, "simPushNullOntoStack", (int a)) \
    X(int, simPushBoolOntoStack, "simPushBoolOntoStack", (int a, bool b)) \
    X(int, simPushInt32OntoStack, "simPushInt32OntoStack", (int a, int b)) \
    X(int, simPushInt64OntoStack, "simPushInt64OntoStack", (int a, long long int b)) \
    X(int, simPushFloatOntoStack, "simPushFloatOntoStack", (int a, float b)) \
    X(int, simPushDoubleOntoStack, "simPushDoubleOntoStack", (int a, double b)) \
    X(int, simPushTextOntoStack, "simPushTextOntoStack", (int a, const char* b)) \
    X(int, simPushStringOntoStack, "simPushStringOntoStack", (int a, const char* b, int nb)) \
    X(int, simPushBufferOntoStack, "simPushBufferOntoStack", (int a, const char* b, int nb)) \
    X(int, simPushUInt8TableOntoStack, "simPushUInt8TableOntoStack", (int a, const unsigned char* b, int nb)) \
    X(int, simPushInt32TableOntoStack, "simPushInt32TableOntoStack", (int a, const int* b, int nb)) \
    X(int, simPushInt64TableOntoStack, "simPushInt64TableOntoStack", (int a, const long long int* b, int nb)) \
    X(int, simPushFloatTableOntoStack, "simPushFloatTableOntoStack", (int a, const float* b, int nb)) \
    X(int, simPushDoubleTableOntoStack, "simPushDoubleTableOntoStack", (int a, const double* b, int nb)) \
    X(int, simPushTableOntoStack, "simPushTableOntoStack", (int a)) \
    X(int, simInsertDataIntoStackTable, "simInsertDataIntoStackTable", (int a)) \
    X(int, simGetStackSize, "simGetStackSize", (int a)) \
    X(int, simPopStackItem, "simPopStackItem", (int a, int b)) \
    X(int, simMoveStackItemToTop, "simMoveStackItemToTop", (int a, int b)) \
    X(int, simGetStackItemType, "simGetStackItemType", (int a, int b)) \
    X(int, simIsStackValueNull, "simIsStackValueNull", (int a)) \
    X(int, simGetStackBoolValue, "simGetStackBoolValue", (int a, bool* b)) \
    X(int, simGetStackInt32Value, "simGetStackInt32Value", (int a, int* b)) \
    X(int, simGetStackInt64Value, "simGetStackInt64Value", (int a, long long int* b)) \
    X(int, simGetStackFloatValue, "simGetStackFloatValue", (int a, float* b)) \
    X(int, simGetStackDoubleValue, "simGetStackDoubleValue", (int a, double* b)) \
    X(char*, simGetStackStringValue, "simGetStackStringValue", (int a, int* b)) \
    X(int, simGetStackTableInfo, "simGetStackTableInfo", (int a, int b)) \
    X(int, simGetStackUInt8Table, "simGetStackUInt8Table", (int a, unsigned char* b, int nb)) \
    X(int, simGetStackInt32Table, "simGetStackInt32Table", (int a, int* b, int nb)) \
    X(int, simGetStackInt64Table, "simGetStackInt64Table", (int a, long long int* b, int nb)) \
    X(int, simGetStackFloatTable, "simGetStackFloatTable", (int a, float* b, int nb)) \
    X(int, simGetStackDoubleTable, "simGetStackDoubleTable", (int a, double* b, int nb)) \
    X(int, simUnfoldStackTable, "simUnfoldStackTable", (int a)) \
    X(int, simDebugStack, "simDebugStack", (int a, int b)) \
    X(char*, simPackTable, "simPackTable", (int a, int* b)) \
    X(int, simUnpackTable, "simUnpackTable", (const char* a, int na)) \
    X(int, simGetObject, "simGetObject", (const char* a, int b, int c, int d)) \
    X(int, simReadProximitySensor, "simReadProximitySensor_D", (int a, double* b, int* c, double* d)) \
    X(int, simHandleProximitySensor, "simHandleProximitySensor_D", (int a, double* b, int* c, double* d)) \
    X(int, simReadForceSensor, "simReadForceSensor_D", (int a, double* b, double* c)) \
    X(int, simCheckCollision, "simCheckCollision", (int a, int b)) \
    X(int, simCheckDistance, "simCheckDistance_D", (int a, int b, double c, double* d)) \
    X(int, simGetObjectPosition, "simGetObjectPosition_D", (int a, int b, double* c)) \
    X(int, simGetObjectOrientation, "simGetObjectOrientation_D", (int a, int b, double* c)) \
    X(int, simGetObjectQuaternion, "simGetObjectQuaternion_D", (int a, int b, double* c)) \
    X(int, simGetObjectPose, "simGetObjectPose_D", (int a, int b, double* c)) \
    X(int, simGetObjectMatrix, "simGetObjectMatrix_D", (int a, int b, double* c)) \
    X(int, simSetObjectPosition, "simSetObjectPosition_D", (int a, int b, const double* c)) \
    X(int, simSetObjectOrientation, "simSetObjectOrientation_D", (int a, int b, const double* c)) \
    X(int, simSetObjectQuaternion, "simSetObjectQuaternion_D", (int a, int b, const double* c)) \
    X(int, simSetObjectPose, "simSetObjectPose_D", (int a, int b, const double* c)) \
    X(int, simSetObjectMatrix, "simSetObjectMatrix_D", (int a, int b, const double* c)) \
    X(int, simGetObjectChildPose, "simGetObjectChildPose_D", (int a, double* b)) \
    X(int, simSetObjectChildPose, "simSetObjectChildPose_D", (int a, const double* b)) \
    X(int, simGetObjectVelocity, "simGetObjectVelocity_D", (int a, double* b, double* c)) \
    X(int, simGetVelocity, "simGetVelocity_D", (int a, double* b, double* c)) \
    X(char*, simGetObjectAlias, "simGetObjectAlias", (int a, int b)) \
    X(int, simSetObjectAlias, "simSetObjectAlias", (int a, const char* b, int c)) \
    X(int, simGetObjectParent, "simGetObjectParent", (int a)) \
    X(int, simSetObjectParent, "simSetObjectParent", (int a, int b, bool c)) \
    X(int, simGetObjectChild, "simGetObjectChild", (int a, int b)) \
    X(int, simGetObjectType, "simGetObjectType", (int a)) \
    X(long long int, simGetObjectUid, "simGetObjectUid", (int a)) \
    X(int, simGetObjectFromUid, "simGetObjectFromUid", (long long int a, int b)) \
    X(int, simGetObjects, "simGetObjects", (int a, int b)) \
    X(int*, simGetObjectsInTree, "simGetObjectsInTree", (int a, int b, int c, int* d)) \
    X(int*, simGetObjectSel, "simGetObjectSel", (int* a)) \
    X(int, simSetObjectSel, "simSetObjectSel", (const int* a, int na)) \
    X(int, simRemoveObjects, "simRemoveObjects", (const int* a, int na)) \
    X(int, simRemoveModel, "simRemoveModel", (int a)) \
    X(int, simCopyPasteObjects, "simCopyPasteObjects", (int* a, int na, int b)) \
    X(int, simScaleObjects, "simScaleObjects_D", (const int* a, int na, double b, bool c)) \
    X(int, simGetObjectInt32Param, "simGetObjectInt32Param", (int a, int b, int* c)) \
    X(int, simSetObjectInt32Param, "simSetObjectInt32Param", (int a, int b, int c)) \
    X(int, simGetObjectFloatParam, "simGetObjectFloatParam_D", (int a, int b, double* c)) \
    X(int, simSetObjectFloatParam, "simSetObjectFloatParam_D", (int a, int b, double c)) \
    X(char*, simGetObjectStringParam, "simGetObjectStringParam", (int a, int b, int* c)) \
    X(int, simSetObjectStringParam, "simSetObjectStringParam", (int a, int b, const char* c, int nc)) \
    X(int, simGetObjectProperty, "simGetObjectProperty", (int a)) \
    X(int, simSetObjectProperty, "simSetObjectProperty", (int a, int b)) \
    X(int, simGetObjectSpecialProperty, "simGetObjectSpecialProperty", (int a)) \
    X(int, simSetObjectSpecialProperty, "simSetObjectSpecialProperty", (int a, int b)) \
    X(int, simGetModelProperty, "simGetModelProperty", (int a)) \
    X(int, simSetModelProperty, "simSetModelProperty", (int a, int b)) \
    X(int, simGetExplicitHandling, "simGetExplicitHandling", (int a)) \
    X(int, simSetExplicitHandling, "simSetExplicitHandling", (int a, int b)) \
    X(int, simGetObjectHierarchyOrder, "simGetObjectHierarchyOrder", (int a, int* b)) \
    X(int, simSetObjectHierarchyOrder, "simSetObjectHierarchyOrder", (int a, int b)) \
    X(double, simGetObjectSizeFactor, "simGetObjectSizeFactor_D", (int a)) \
    X(int, simGetObjectColor, "simGetObjectColor", (int a, int b, int c, float* d)) \
    X(int, simSetObjectColor, "simSetObjectColor", (int a, int b, int c, const float* d)) \
    X(int, simIsHandle, "simIsHandle", (int a, int b)) \
    X(int, simIsDynamicallyEnabled, "simIsDynamicallyEnabled", (int a)) \
    X(int, simResetDynamicObject, "simResetDynamicObject", (int a)) \
    X(char*, simGetExtensionString, "simGetExtensionString", (int a, int b, const char* c)) \
    X(int, simGetLinkDummy, "simGetLinkDummy", (int a)) \
    X(int, simSetLinkDummy, "simSetLinkDummy", (int a, int b)) \
    X(int, simGetJointPosition, "simGetJointPosition_D", (int a, double* b)) \
    X(int, simSetJointPosition, "simSetJointPosition_D", (int a, double b)) \
    X(int, simGetJointTargetPosition, "simGetJointTargetPosition_D", (int a, double* b)) \
    X(int, simSetJointTargetPosition, "simSetJointTargetPosition_D", (int a, double b)) \
    X(int, simGetJointTargetVelocity, "simGetJointTargetVelocity_D", (int a, double* b)) \
    X(int, simSetJointTargetVelocity, "simSetJointTargetVelocity_D", (int a, double b)) \
    X(int, simGetJointTargetForce, "simGetJointTargetForce_D", (int a, double* b)) \
    X(int, simSetJointTargetForce, "simSetJointTargetForce_D", (int a, double b, bool c)) \
    X(int, simGetJointForce, "simGetJointForce_D", (int a, double* b)) \
    X(int, simGetJointVelocity, "simGetJointVelocity_D", (int a, double* b)) \
    X(int, simGetJointInterval, "simGetJointInterval_D", (int a, bool* b, double* c)) \
    X(int, simSetJointInterval, "simSetJointInterval_D", (int a, bool b, const double* c)) \
    X(int, simGetJointMatrix, "simGetJointMatrix_D", (int a, double* b)) \
    X(int, simSetSphericalJointMatrix, "simSetSphericalJointMatrix_D", (int a, const double* b)) \
    X(int, simGetJointMode, "simGetJointMode", (int a, int* b)) \
    X(int, simSetJointMode, "simSetJointMode", (int a, int b, int c)) \
    X(int, simGetJointType, "simGetJointType", (int a)) \
    X(int, simGetJointDependency, "simGetJointDependency_D", (int a, int* b, double* c, double* d)) \
    X(int, simSetJointDependency, "simSetJointDependency_D", (int a, int b, double c, double d)) \
    X(int, simCreateDummy, "simCreateDummy_D", (double a, const void* b)) \
    X(int, simCreateJoint, "simCreateJoint_D", (int a, int b, int c, const double* d, const void* e, const void* f)) \
    X(int, simCreatePrimitiveShape, "simCreatePrimitiveShape_D", (int a, const double* b, int c)) \
    X(int, simCreateMeshShape, "simCreateMeshShape_D", (int a, double b, const double* c, int nc, const int* d, int nd, const void* e)) \
    X(int, simCreateForceSensor, "simCreateForceSensor_D", (int a, const int* b, const double* c, const void* d)) \
    X(int, simCreateProximitySensor, "simCreateProximitySensor_D", (int a, int b, int c, const int* d, const double* e, const void* f)) \
    X(int, simCreateVisionSensor, "simCreateVisionSensor_D", (int a, const int* b, const double* c, const void* d)) \
    X(int, simGetShapeMass, "simGetShapeMass_D", (int a, double* b)) \
    X(int, simSetShapeMass, "simSetShapeMass_D", (int a, double b)) \
    X(int, simGetShapeInertia, "simGetShapeInertia_D", (int a, double* b, double* c)) \
    X(int, simSetShapeInertia, "simSetShapeInertia_D", (int a, const double* b, const double* c)) \
    X(int, simComputeMassAndInertia, "simComputeMassAndInertia_D", (int a, double b)) \
    X(int, simSetShapeColor, "simSetShapeColor", (int a, const char* b, int c, const float* d)) \
    X(int, simGroupShapes, "simGroupShapes", (const int* a, int na)) \
    X(int, simAddForce, "simAddForce_D", (int a, const double* b, const double* c)) \
    X(int, simAddForceAndTorque, "simAddForceAndTorque_D", (int a, const double* b, const double* c)) \
    X(int, simResetProximitySensor, "simResetProximitySensor", (int a)) \
    X(int, simResetVisionSensor, "simResetVisionSensor", (int a)) \
    X(int, simResetGraph, "simResetGraph", (int a)) \
    X(int, simSetGraphStreamValue, "simSetGraphStreamValue_D", (int a, int b, double c)) \
    X(int, simGetVisionSensorRes, "simGetVisionSensorRes", (int a, int* b)) \
    X(char*, simGetVisionSensorImg, "simGetVisionSensorImg_D", (int a, int b, double c, const int* d, const int* e, int* f)) \
    X(int, simCreateCollectionEx, "simCreateCollectionEx", (int a)) \
    X(int, simAddItemToCollection, "simAddItemToCollection", (int a, int b, int c, int d)) \
    X(int, simDestroyCollection, "simDestroyCollection", (int a)) \
    X(int*, simGetCollectionObjects, "simGetCollectionObjects", (int a, int* b)) \
    X(int, simBuildIdentityMatrix, "simBuildIdentityMatrix_D", (double* a)) \
    X(int, simBuildMatrix, "simBuildMatrix_D", (const double* a, const double* b, double* c)) \
    X(int, simBuildPose, "simBuildPose_D", (const double* a, const double* b, double* c)) \
    X(int, simInvertMatrix, "simInvertMatrix_D", (double* a)) \
    X(int, simInvertPose, "simInvertPose_D", (double* a)) \
    X(int, simMultiplyMatrices, "simMultiplyMatrices_D", (const double* a, const double* b, double* c)) \
    X(int, simMultiplyPoses, "simMultiplyPoses_D", (const double* a, const double* b, double* c)) \
    X(int, simInterpolateMatrices, "simInterpolateMatrices_D", (const double* a, const double* b, double c, double* d)) \
    X(int, simInterpolatePoses, "simInterpolatePoses_D", (const double* a, const double* b, double c, double* d)) \
    X(int, simMatrixToPose, "simMatrixToPose_D", (const double* a, double* b)) \
    X(int, simPoseToMatrix, "simPoseToMatrix_D", (const double* a, double* b)) \
    X(int, simTransformVector, "simTransformVector_D", (const double* a, double* b)) \
    X(int, simGetEulerAnglesFromMatrix, "simGetEulerAnglesFromMatrix_D", (const double* a, double* b)) \
    X(int, simGetRotationAxis, "simGetRotationAxis_D", (const double* a, const double* b, double* c, double* d)) \
    X(int, simRotateAroundAxis, "simRotateAroundAxis_D", (const double* a, const double* b, const double* c, double d, double* e)) \
    X(double, simGetSimulationTime, "simGetSimulationTime_D", (void)) \
    X(int, simGetSimulationState, "simGetSimulationState", (void)) \
    X(double, simGetSimulationTimeStep, "simGetSimulationTimeStep_D", (void)) \
    X(int, simSetSimulationTimeStep, "simSetSimulationTimeStep_D", (double a)) \
    X(int, simGetRealTimeSimulation, "simGetRealTimeSimulation", (void)) \
    X(double, simGetSystemTime, "simGetSystemTime_D", (void)) \
    X(int, simStartSimulation, "simStartSimulation", (void)) \
    X(int, simPauseSimulation, "simPauseSimulation", (void)) \
    X(int, simStopSimulation, "simStopSimulation", (void)) \
    X(int, simAnnounceSceneContentChange, "simAnnounceSceneContentChange", (void)) \
    X(int, simLoadScene, "simLoadScene", (const char* a)) \
    X(int, simLoadModel, "simLoadModel", (const char* a)) \
    X(int, simSaveScene, "simSaveScene", (const char* a)) \
    X(int, simSaveModel, "simSaveModel", (int a, const char* b)) \
    X(int, simCloseScene, "simCloseScene", (void)) \
    X(int, simGetBoolParam, "simGetBoolParam", (int a)) \
    X(int, simSetBoolParam, "simSetBoolParam", (int a, bool b)) \
    X(int, simGetInt32Param, "simGetInt32Param", (int a, int* b)) \
    X(int, simSetInt32Param, "simSetInt32Param", (int a, int b)) \
    X(int, simGetFloatParam, "simGetFloatParam_D", (int a, double* b)) \
    X(int, simSetFloatParam, "simSetFloatParam_D", (int a, double b)) \
    X(char*, simGetStringParam, "simGetStringParam", (int a)) \
    X(int, simSetStringParam, "simSetStringParam", (int a, const char* b)) \
    X(int, simGetArrayParam, "simGetArrayParam_D", (int a, double* b)) \
    X(int, simSetArrayParam, "simSetArrayParam_D", (int a, const double* b)) \
    X(char*, simGetNamedStringParam, "simGetNamedStringParam", (const char* a, int* b)) \
    X(int, simSetNamedStringParam, "simSetNamedStringParam", (const char* a, const char* b, int nb)) \
    X(int, simSetInt32Signal, "simSetInt32Signal", (const char* a, int b)) \
    X(int, simGetInt32Signal, "simGetInt32Signal", (const char* a, int* b)) \
    X(int, simClearInt32Signal, "simClearInt32Signal", (const char* a)) \
    X(int, simSetFloatSignal, "simSetFloatSignal_D", (const char* a, double b)) \
    X(int, simGetFloatSignal, "simGetFloatSignal_D", (const char* a, double* b)) \
    X(int, simClearFloatSignal, "simClearFloatSignal", (const char* a)) \
    X(int, simSetStringSignal, "simSetStringSignal", (const char* a, const char* b, int nb)) \
    X(char*, simGetStringSignal, "simGetStringSignal", (const char* a, int* b)) \
    X(int, simClearStringSignal, "simClearStringSignal", (const char* a)) \
    X(char*, simReadCustomDataBlock, "simReadCustomDataBlock", (int a, const char* b, int* c)) \
    X(int, simWriteCustomDataBlock, "simWriteCustomDataBlock", (int a, const char* b, const char* c, int nc)) \
    X(char*, simPersistentDataRead, "simPersistentDataRead", (const char* a, int* b)) \
    X(int, simPersistentDataWrite, "simPersistentDataWrite", (const char* a, const char* b, int nb, int c)) \
    X(int, simAuxiliaryConsoleOpen, "simAuxiliaryConsoleOpen", (const char* a, int b, int c, const int* d, const int* e, const float* f, const float* g)) \
    X(int, simAuxiliaryConsolePrint, "simAuxiliaryConsolePrint", (int a, const char* b)) \
    X(int, simAuxiliaryConsoleShow, "simAuxiliaryConsoleShow", (int a, bool b)) \
    X(int, simAuxiliaryConsoleClose, "simAuxiliaryConsoleClose", (int a)) \
    X(int, simGetBoolProperty, "simGetBoolProperty", (long long int a, const char* b, int* c)) \
    X(int, simSetBoolProperty, "simSetBoolProperty", (long long int a, const char* b, int c)) \
    X(int, simGetIntProperty, "simGetIntProperty", (long long int a, const char* b, int* c)) \
    X(int, simSetIntProperty, "simSetIntProperty", (long long int a, const char* b, int c)) \
    X(int, simGetLongProperty, "simGetLongProperty", (long long int a, const char* b, long long int* c)) \
    X(int, simSetLongProperty, "simSetLongProperty", (long long int a, const char* b, long long int c)) \
    X(int, simGetFloatProperty, "simGetFloatProperty", (long long int a, const char* b, double* c)) \
    X(int, simSetFloatProperty, "simSetFloatProperty", (long long int a, const char* b, double c)) \
    X(char*, simGetStringProperty, "simGetStringProperty", (long long int a, const char* b)) \
    X(int, simGetStringProperty2, "simGetStringProperty2", (long long int a, const char* b, char** c)) \
    X(int, simSetStringProperty, "simSetStringProperty", (long long int a, const char* b, const char* c)) \
    X(char*, simGetBufferProperty, "simGetBufferProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetBufferProperty2, "simGetBufferProperty2", (long long int a, const char* b, char** c, int* d)) \
    X(int, simSetBufferProperty, "simSetBufferProperty", (long long int a, const char* b, const char* c, int nc)) \
    X(int, simGetIntArray2Property, "simGetIntArray2Property", (long long int a, const char* b, int* c)) \
    X(int, simSetIntArray2Property, "simSetIntArray2Property", (long long int a, const char* b, const int* c)) \
    X(int, simGetVector2Property, "simGetVector2Property", (long long int a, const char* b, double* c)) \
    X(int, simSetVector2Property, "simSetVector2Property", (long long int a, const char* b, const double* c)) \
    X(int, simGetVector3Property, "simGetVector3Property", (long long int a, const char* b, double* c)) \
    X(int, simSetVector3Property, "simSetVector3Property", (long long int a, const char* b, const double* c)) \
    X(int, simGetQuaternionProperty, "simGetQuaternionProperty", (long long int a, const char* b, double* c)) \
    X(int, simSetQuaternionProperty, "simSetQuaternionProperty", (long long int a, const char* b, const double* c)) \
    X(int, simGetPoseProperty, "simGetPoseProperty", (long long int a, const char* b, double* c)) \
    X(int, simSetPoseProperty, "simSetPoseProperty", (long long int a, const char* b, const double* c)) \
    X(int, simGetColorProperty, "simGetColorProperty", (long long int a, const char* b, float* c)) \
    X(int, simSetColorProperty, "simSetColorProperty", (long long int a, const char* b, const float* c)) \
    X(double*, simGetFloatArrayProperty, "simGetFloatArrayProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetFloatArrayProperty2, "simGetFloatArrayProperty2", (long long int a, const char* b, double** c, int* d)) \
    X(int, simSetFloatArrayProperty, "simSetFloatArrayProperty", (long long int a, const char* b, const double* c, int nc)) \
    X(int*, simGetIntArrayProperty, "simGetIntArrayProperty", (long long int a, const char* b, int* c)) \
    X(int, simGetIntArrayProperty2, "simGetIntArrayProperty2", (long long int a, const char* b, int** c, int* d)) \
    X(int, simSetIntArrayProperty, "simSetIntArrayProperty", (long long int a, const char* b, const int* c, int nc)) \
    X(int, simRemoveProperty, "simRemoveProperty", (long long int a, const char* b)) \
    X(int*, simUngroupShape, "simUngroupShape", (int a, int* b))

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
