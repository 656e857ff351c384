-- topic: old functions
-- as: customization
-- passes: 0
-- spec: vrep-era 2.3
sim = require 'sim'
function sysCall_init()
    for _, n in ipairs{'simGetObjectHandle', 'simGetObjectPosition', 'simHandleChildScripts', 'simHandleChildScript',
        'simDelegateChildScriptExecution', 'simHandleSensingChildScripts', 'simHandlePath', 'simHandleJoint',
        'simGetScriptExecutionCount', 'simGetUIHandle', 'simGet2DElementHandle', 'simRMLPos', 'simPackFloats',
        'simGetInvertedMatrix', 'simGetSystemTimeInMilliseconds', 'simReadRenderingSensor', 'simSearchPath',
        'simGetPathPosition', 'simSetThreadSwitchTiming', 'simRMLMoveToPosition'} do
        if type(_G[n]) ~= 'function' then print(n, type(_G[n])) end
    end
    print(sim_handle_all, sim_handle_self, sim_sceneobject_path, sim_handle_all_except_explicit)
    print(select('#', simHandleSensingChildScripts()), select('#', simDelegateChildScriptExecution()))
    print(simGetInstanceIndex(), simLockInterface(), simEnableWorkThreads(), select('#', simWaitForWorkThreads()))
    print(simIsScriptExecutionThreaded(), simIsScriptRunningInThread(), simGetScriptHandle() == sim.getScript(sim.handle_self))
    print(#simPackFloats({1, 2}), simGetInvertedMatrix({1, 0, 0, 1, 0, 1, 0, 2, 0, 0, 1, 3})[8])
end
