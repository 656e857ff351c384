--[[
Shared by path_customization.lua: the dialog of a path, and that of one of its control points, which opens with it when the point is selected.
]]

local sim = _quietRequire 'sim'
local window = require 'swanilda.settings_window'
local points = require 'swanilda.paths.points'
local M = {}

local HIDDEN <const>, CLOSED <const>, SHAPE <const>, COMPUTE_ORIENTATION <const>, ALWAYS_HIDDEN <const> = 1, 2, 4, 16, 32
local MIN_SMOOTHING <const>, MIN_SAMPLES <const>, MAX_SAMPLES <const> = 0.05, 10, 1000
local MODES <const> = {
    'x along the path, y up', 'x along the path, z up', 'y along the path, x up', 'y along the path, z up', 'z along the path, x up',
    'z along the path, y up',
}

-- A field whose value is a bit of the settings, or a member.
local function option(path, text, flag)
    return {
        kind = 'check', text = text,
        read = function() return path.readInfo().bitCoded & flag ~= 0 end,
        write = function(isOn)
            local info = path.readInfo()
            info.bitCoded = isOn and info.bitCoded | flag or info.bitCoded & ~flag
            path.writeInfo(info)
            path.setup()
        end,
    }
end

local function member(path, field, name, toValue)
    field.read = function() return path.readInfo()[name] end
    field.write = function(value)
        local info = path.readInfo()
        info[name] = toValue(value)
        path.writeInfo(info)
        path.setup()
    end
    return field
end

local function smoothing(value) return value < MIN_SMOOTHING and 0 or math.min(1, value) end

local function count(value) return math.max(MIN_SAMPLES, math.min(MAX_SAMPLES, math.floor(value))) end

local function fieldsOf(path)
    return {
        option(path, 'hidden while a simulation runs', HIDDEN),
        option(path, 'always hidden', ALWAYS_HIDDEN),
        option(path, 'closed', CLOSED),
        option(path, 'a shape along it', SHAPE),
        member(path, {kind = 'number', text = 'points', minimum = MIN_SAMPLES, maximum = MAX_SAMPLES}, 'pointCnt', count),
        member(path, {kind = 'number', text = 'smoothing', minimum = 0, maximum = 1, step = 0.05}, 'smoothing', smoothing),
        option(path, 'orientation computed', COMPUTE_ORIENTATION),
        member(path, {kind = 'choice', text = 'axes', items = MODES}, 'autoOrientation', math.floor),
    }
end

local function channel(path, point, text, read, write)
    return {
        kind = 'number', text = text, minimum = -1e6, maximum = 1e6, step = 0.01,
        read = function() return read(points.read(point) or {}) end,
        write = function(value)
            local data = points.read(point)
            if not data then return end
            write(data, value)
            points.write(point, data)
            path.forceFullRebuild = true
            path.setup()
        end,
    }
end

--- Opens the dialog of a control point: virtual distance and auxiliary channels.
function M.openPoint(path, point)
    M.closePoint(path)
    local fields = {channel(path, point, 'virtual distance', function(data) return data.virtualDist or 0 end,
        function(data, value) data.virtualDist = value end)}
    for i = 1, 4 do
        fields[i + 1] = channel(path, point, 'channel ' .. i, function(data) return (data.auxChannels or {0, 0, 0, 0})[i] end,
            function(data, value)
                data.auxChannels = data.auxChannels or {0, 0, 0, 0}
                data.auxChannels[i] = value
            end)
    end
    window.open(path, '_S.path', 'pointDialog', sim.getObjectAlias(point, 1), fields)
end

function M.closePoint(path) window.close(path, 'pointDialog') end

--- Opens the dialog of a path.
function M.open(path)
    if path.dialog or sim.getSimulationState() ~= sim.simulation_stopped then return end
    window.open(path, '_S.path', 'dialog', sim.getObjectAlias(path.model, 1), fieldsOf(path))
end

--- Closes both.
function M.close(path)
    M.closePoint(path)
    window.close(path, 'dialog')
end

return M
