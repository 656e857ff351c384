--[[
Script of groups of joints: an object whose referenced handles are its joints. `require 'models.jointGroup_customization'` defines these functions of the script, which other
scripts call (spec: models 6):

    getJoints(), isDynamicallyEnabled(), getConfig(), setConfig(config), getTargetConfig(), setTargetConfig(config)
    moveToConfig(options)                         begins a motion: targetPos; maxVel, maxAccel, maxJerk of each joint. It goes on with each step
    moveToConfigInit(options), moveToConfigStep(), moveToConfigCleanup(), isMoveToConfigRunning()
    followPath(path, parameters)                  a temporary script moves the joints along the states of a path
]]

local sim = _quietRequire 'sim'

local MAX_VEL <const>, MAX_ACCEL <const>, MAX_JERK <const> = math.rad(1440), math.rad(720), math.rad(360)
local motion

-- The group is the script itself, or the object it belongs to.
local function group()
    local object = sim.getObject('.')
    if sim.getObjectType(object) ~= sim.sceneobject_script or #sim.getReferencedHandles(object) > 0 then return object end
    return sim.getObjectParent(object)
end

function getJoints() return sim.getReferencedHandles(group()) end

local function ofAll(read)
    local values = {}
    for i, joint in ipairs(getJoints()) do values[i] = read(joint) end
    return values
end

local function setAll(config, write)
    local joints = getJoints()
    if type(config) ~= 'table' or #config ~= #joints then error(('a configuration of %d values is needed'):format(#joints), 3) end
    for i, joint in ipairs(joints) do write(joint, config[i]) end
end

--- Whether all joints are.
function isDynamicallyEnabled()
    for _, joint in ipairs(getJoints()) do
        if not sim.isDynamicallyEnabled(joint) then return false end
    end
    return true
end

function getConfig() return ofAll(sim.getJointPosition) end

function setConfig(config) setAll(config, sim.setJointPosition) end

function getTargetConfig() return ofAll(sim.getJointTargetPosition) end

local function setTarget(joint, position)
    if sim.isDynamicallyEnabled(joint) then
        sim.setJointTargetPosition(joint, position)
    else
        sim.setJointPosition(joint, position)
    end
end

--- Target positions of joints that physics moves, positions of the others.
function setTargetConfig(config) setAll(config, setTarget) end

local function limits(value, default, count)
    local list = {}
    for i = 1, count do list[i] = type(value) == 'table' and value[i] or tonumber(value) or default end
    return list
end

function moveToConfigInit(options)
    moveToConfigCleanup()
    local joints = getJoints()
    motion = sim.moveToConfig_init{
        joints = joints, targetPos = options.targetPos, maxVel = limits(options.maxVel, MAX_VEL, #joints),
        maxAccel = limits(options.maxAccel, MAX_ACCEL, #joints), maxJerk = limits(options.maxJerk, MAX_JERK, #joints),
    }
end

function isMoveToConfigRunning() return motion ~= nil end

--- One step of a motion; ends it when the joints are there.
function moveToConfigStep()
    if motion and sim.moveToConfig_step(motion) ~= 0 then moveToConfigCleanup() end
end

function moveToConfigCleanup()
    if not motion then return end
    sim.moveToConfig_cleanup(motion)
    motion = nil
end

function moveToConfig(options) moveToConfigInit(options) end

local function literal(value)
    if type(value) ~= 'table' then return type(value) == 'string' and ('%q'):format(value) or tostring(value) end
    local parts = {}
    for i, part in ipairs(value) do parts[i] = literal(part) end
    return '{' .. table.concat(parts, ', ') .. '}'
end

--- Moves along a path.
-- @param path object with the states of the joints, as made by models.robotConfigPath-3
-- @param parameters fkMaxVel, fkMaxAccel: limits of each joint
-- @return handle of the script
function followPath(path, parameters)
    local lines = {"require 'models.followPath_simulation'"}
    for _, name in ipairs{'fkMaxVel', 'fkMaxAccel'} do
        if parameters and parameters[name] then lines[#lines + 1] = name .. ' = ' .. literal(parameters[name]) end
    end
    local script = sim.createScript(sim.scripttype_simulation, table.concat(lines, '\n'))
    sim.setObjectParent(script, group())
    sim.setReferencedHandles(script, {path}, 'path')
    if #sim.getReferencedHandles(path, 'jointGroup') == 0 then sim.setReferencedHandles(path, {group()}, 'jointGroup') end
    return script
end

function sysCall_init() end

function sysCall_actuation() moveToConfigStep() end

function sysCall_afterSimulation() moveToConfigCleanup() end

function sysCall_cleanup() moveToConfigCleanup() end
