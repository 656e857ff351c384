--[[
Types are `pkg/msg/Name`, `pkg/srv/Name`, `pkg/action/Name`. The common packages are built in; others are found in AMENT_PREFIX_PATH, in the
folders of --ros-interfaces, and beside the scene. Messages are tables with exactly the fields of the type; integers of 64 bits are floats.

Nothing is bound or sent outside of this machine unless the program runs with --ros-network. The domain is that of ROS_DOMAIN_ID.
Named parameters: ROS2Interface.nodeName, ROS2Interface.domainId.
]]

local _, simROS2 = ...
if not simROS2 then error('this Swanilda was built without the feature ros2', 0) end
local sim = require('sim')

--- A time in seconds as a table.
-- @api table t = simROS2.timeFromFloat(float t)
-- @param t seconds
-- @return t {sec, nanosec}
function simROS2.timeFromFloat(t)
    local sec = math.floor(t)
    return {sec = sec, nanosec = math.floor((t - sec) * 1e9)}
end

--- A time as a table in seconds.
-- @api float t = simROS2.timeToFloat(table t)
-- @param t {sec, nanosec}
-- @return t seconds
function simROS2.timeToFloat(t) return t.sec + t.nanosec * 1e-9 end

--- The time of the system.
-- @api table t = simROS2.getSystemTime()
-- @return t {sec, nanosec}
function simROS2.getSystemTime() return simROS2.timeFromFloat(sim.getSystemTime()) end

--- The time of the simulation.
-- @api table t = simROS2.getSimulationTime()
-- @return t {sec, nanosec}
function simROS2.getSimulationTime() return simROS2.timeFromFloat(sim.getSimulationTime()) end

--- Makes a type a global: `geometry_msgs.msg.Point` has the constants of the type, `__name`, and `__new()`, which creates a table of it.
-- @api simROS2.importInterface(string name)
-- @param name `pkg/msg/Name`
function simROS2.importInterface(name)
    local package, kind, short = name:match('^([^/]+)/([^/]+)/([^/]+)$')
    if not package then error('not the name of an interface: ' .. name, 2) end
    local interface = simROS2.getInterfaceConstants(name)
    interface.__name = name
    interface.__new = function() return simROS2.createInterface(name) end
    _G[package] = _G[package] or {}
    _G[package][kind] = _G[package][kind] or {}
    _G[package][kind][short] = interface
end

local DEBUG <const>, INFO <const>, WARNING <const>, ERROR <const> = 10, 20, 30, 40 -- levels of rcl_interfaces/msg/Log
local LEVELS <const> = {
    [sim.verbosity_errors] = ERROR, [sim.verbosity_scripterrors] = ERROR,
    [sim.verbosity_warnings] = WARNING, [sim.verbosity_scriptwarnings] = WARNING,
    [sim.verbosity_infos] = INFO, [sim.verbosity_scriptinfos] = INFO, [sim.verbosity_loadinfos] = INFO,
}

--- Adds a line to the log, and publishes it at `/rosout` once there is a node.
-- @api simROS2.log(int verbosity, string msg)
-- @param verbosity sim.verbosity_*
-- @param msg the line
function simROS2.log(verbosity, msg)
    sim.addLog(verbosity, msg)
    simROS2._publishLog(LEVELS[verbosity] or DEBUG, msg)
end

-- Names of earlier versions say what they are called now, and do nothing else, as in the original.
local RENAMED <const> = {
    subscribe = 'createSubscription',
    shutdownSubscriber = 'shutdownSubscription',
    subscriberTreatUInt8ArrayAsString = 'subscriptionTreatUInt8ArrayAsString',
    advertise = 'createPublisher',
    serviceClient = 'createClient',
    shutdownServiceClient = 'shutdownClient',
    serviceClientTreatUInt8ArrayAsString = 'clientTreatUInt8ArrayAsString',
    advertiseService = 'createService',
    shutdownServiceServer = 'shutdownService',
    serviceServerTreatUInt8ArrayAsString = 'serviceTreatUInt8ArrayAsString',
    imageTransportSubscribe = 'imageTransportCreateSubscription',
    imageTransportShutdownSubscriber = 'imageTransportShutdownSubscription',
    imageTransportAdvertise = 'imageTransportCreatePublisher',
}

for old, new in pairs(RENAMED) do
    simROS2[old] = function()
        sim.addLog(sim.verbosity_scripterrors, ('simROS2.%s has been renamed to simROS2.%s'):format(old, new))
    end
end

return simROS2
