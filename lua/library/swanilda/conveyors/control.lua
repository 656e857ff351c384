--[[
Shared by the scripts of conveyors: how scripts drive them (spec: models 5). A drive has the position of the belt and its velocity; users write a velocity or a
position into custom data of the model.

`M.drive` is for the later models (`__ctrl__`, `__state__`), `M.oldDrive` for those of 4.1 and 4.2 (`CONVMOV`).
]]

local sim = _quietRequire 'sim'
local M = {}

local COMMAND <const>, STATE <const>, INFO <const> = '__ctrl__', '__state__', '__info__'
local JERK <const>, MAX_SPEED <const>, CYCLE <const> = 99999, 99999, 0.0001

---------------------------------------------------------------- the later models

local Drive = {}
Drive.__index = Drive

--- A drive; `move(position)` puts pads or rollers where they belong.
function M.drive(model, move)
    return setmetatable({model = model, move = move, pos = 0, vel = 0, accel = 0, target = {vel = 0}}, Drive)
end

--- What custom data a conveyor has, for programs that look for conveyors.
function M.describe(model)
    local info = sim.readCustomTableData(model, INFO)
    info.type = 'conveyor'
    info.blocks = info.blocks or {}
    for _, name in ipairs{'__config__', COMMAND, STATE} do info.blocks[name] = {type = 'table'} end
    sim.writeCustomTableData(model, INFO, info)
end

--- Stands at 0 and runs with the velocity of the settings from now on.
function Drive:restart(config)
    self.pos, self.vel, self.accel, self.target = 0, 0, config.accel, {vel = config.targetVel}
end

function Drive:writeState() sim.writeCustomTableData(self.model, STATE, {pos = self.pos, vel = self.vel}) end

function Drive:readCommand()
    local command = sim.readCustomTableData(self.model, COMMAND)
    if next(command) == nil then return end
    sim.writeCustomTableData(self.model, COMMAND, {})
    if tonumber(command.vel) then
        self.target = {vel = command.vel}
    elseif tonumber(command.pos) then
        self.target = {pos = command.pos}
    end
end

-- One step of a trajectory; nil when it is at its end.
local function advance(trajectory, dt)
    local result, pva = sim.ruckigStep(trajectory, dt)
    sim.ruckigRemove(trajectory)
    return result == 0 and pva or nil
end

function Drive:towardsVelocity(dt)
    local vel = self.target.vel
    local pva = self.vel ~= vel and advance(
        sim.ruckigVel(1, CYCLE, -1, {self.pos, self.vel, 0}, {self.accel, JERK}, {1}, {vel}), dt)
    if pva then
        self.pos, self.vel = pva[1], pva[2]
    else
        self.pos, self.vel = self.pos + vel * dt, vel
    end
end

function Drive:towardsPosition(dt)
    local pos = self.target.pos
    local isThere = self.pos == pos and self.vel == 0
    local pva = not isThere and advance(
        sim.ruckigPos(1, CYCLE, -1, {self.pos, self.vel, 0}, {MAX_SPEED, self.accel, JERK}, {1}, {pos, 0}), dt)
    if pva then
        self.pos, self.vel = pva[1], pva[2]
    else
        self.pos, self.vel = pos, 0
    end
end

--- One step.
function Drive:actuation()
    self:readCommand()
    local before, dt = self.pos, sim.getSimulationTimeStep()
    if self.target.pos then self:towardsPosition(dt) else self:towardsVelocity(dt) end
    if self.pos == before then return end
    self.move(self.pos, (self.pos - before) / dt)
    self:writeState()
end

--- After a simulation: as before it, but nothing moves until the next.
function Drive:afterSimulation(config)
    self:restart(config)
    self:writeState()
end

---------------------------------------------------------------- the old models

local OLD <const> = 'CONVMOV'

--- A drive of an old model. `field` names the position in its custom data, `offset` or `pos`.
function M.oldDrive(model, field, config, move)
    local drive = {model = model, pos = config.initPos or 0, vel = config.initVel or 0}

    local function read()
        local packed = sim.readCustomBufferData(model, OLD)
        local data = packed and #packed > 0 and sim.unpackTable(packed)
        return type(data) == 'table' and data or {}
    end

    function drive.actuation()
        local data = read()
        local jump, vel = tonumber(data[field]), tonumber(data.vel) or config.initVel or 0
        if jump then
            drive.pos = jump
        else
            drive.pos = drive.pos + vel * sim.getSimulationTimeStep()
        end
        if not jump and vel == 0 then return end
        move(drive.pos)
        data.currentPos = drive.pos
        sim.writeCustomBufferData(model, OLD, sim.packTable(data))
    end

    function drive.afterSimulation()
        drive.pos = config.initPos or 0
        move(drive.pos)
        sim.writeCustomBufferData(model, OLD, sim.packTable{currentPos = drive.pos})
    end

    return drive
end

return M
