--[[
The recordings of `swanilda.test`: named quantities over time. Internal.
]]

local sim = require('sim')

-- `time` and `signal` are those of the fixture, which sets them.
local M = {}

local Recording = {}
Recording.__index = Recording

local POSE = { 'x', 'y', 'z', 'qx', 'qy', 'qz', 'qw' }

local function addColumns(recording, label, suffixes, read)
    for _, suffix in ipairs(suffixes) do table.insert(recording.columns, suffix == '' and label or label .. '.' .. suffix) end
    table.insert(recording.sources, { read = read, count = #suffixes, label = label })
end

-- A path of a joint is its position, of another object its pose; signal:NAME a signal.
local function addNamed(recording, text)
    local signal = text:match('^signal:(.+)$')
    if signal then return addColumns(recording, text, { '' }, function() return { M.signal(signal) } end) end
    local handle = sim.getObject(text)
    local kind = sim.getObjectType(handle)
    if kind == sim.sceneobject_joint and sim.getJointType(handle) ~= sim.joint_spherical then
        return addColumns(recording, text, { '' }, function() return { sim.getJointPosition(handle) } end)
    end
    addColumns(recording, text, POSE, function() return sim.getObjectPose(handle) end)
end

local function addFunction(recording, label, fn)
    local first = fn()
    if type(first) ~= 'table' then
        return addColumns(recording, label, { '' }, function() return { fn() } end)
    end
    local suffixes = {}
    for i = 1, #first do suffixes[i] = tostring(i) end
    addColumns(recording, label, suffixes, fn)
end

function Recording:sample()
    local time = M.time()
    if self.stopped or self.next > time * (1 + 1e-12) + 1e-12 then return end
    self.next = time + self.every
    local row = { time + 0.0 }
    for _, source in ipairs(self.sources) do
        local values = source.read()
        for i = 1, source.count do
            if type(values[i]) ~= 'number' then
                error(("golden '%s': %s is no number but %s."):format(self.name, source.label, tostring(values[i])), 0)
            end
            row[#row + 1] = values[i] + 0.0
        end
    end
    self.rows[#self.rows + 1] = row
end

function Recording:stop() self.stopped = true end

--- Records named quantities from now on.
function M.begin(name, quantities, options)
    options = options or {}
    local recording = setmetatable(
        { name = name, columns = {}, sources = {}, rows = {}, next = 0, every = options.every or 0, options = options },
        Recording
    )
    for _, quantity in ipairs(quantities) do addNamed(recording, quantity) end
    local labels = {}
    for label in pairs(quantities) do
        if type(label) == 'string' then labels[#labels + 1] = label end
    end
    table.sort(labels)
    for _, label in ipairs(labels) do addFunction(recording, label, quantities[label]) end
    if #recording.columns == 0 then error(("golden '%s' has nothing to record."):format(name), 3) end
    return recording
end

return M
