--[[
Topics of a robot: their names, qualities of service and times. Internal.
]]

local simROS2 = require('simROS2')

local M = {}

local RELIABLE <const>, TRANSIENT_LOCAL <const> = simROS2.qos_reliability_policy.reliable, simROS2.qos_durability_policy.transient_local

--- Both reliable readers and those of sensor data, which are best effort, understand a reliable writer.
M.SENSOR = {reliability = RELIABLE, depth = 5}
--- What is said once, also to those who come later.
M.LATCHED = {reliability = RELIABLE, durability = TRANSIENT_LOCAL, depth = 1}
M.FRAMES = {reliability = RELIABLE, depth = 100}

--- Whether anything reads what a publisher publishes; the robots set it.
function M.hasReaders() return true end

--- Says at which times something is due: `rate` per second of simulation, or each step if it is 0.
function M.clock(rate)
    local period, next = rate > 0 and 1 / rate or 0, 0
    return {
        isDue = function(time)
            if time < next - 1e-9 then return false end
            next = math.max(next + period, time)
            return true
        end,
        reset = function() next = 0 end,
    }
end

-- Names for topics: letters, digits, _ and /.
local function clean(name) return (name:gsub('^~/', ''):gsub('[^%w_/]', '_'):gsub('//+', '/'):gsub('/$', '')) end

--- The topics of a robot, whose relative names are in the namespace.
function M.new(namespace)
    local handles, names = {}, {}
    local topics = {}

    --- The whole name of a topic.
    function topics.resolve(name)
        name = clean(name)
        if name:sub(1, 1) == '/' then return name end
        local before = clean('/' .. (namespace or ''))
        return before .. '/' .. name
    end

    local function note(name, end_) names[#names + 1], handles[#handles + 1] = name, end_ end

    function topics.publisher(name, kind, qos)
        local full = topics.resolve(name)
        local publisher = simROS2.createPublisher(full, kind, 0, false, qos)
        note(full, function() simROS2.shutdownPublisher(publisher) end)
        return publisher
    end

    --- A publisher of messages whose bytes are strings.
    function topics.bytesPublisher(name, kind)
        local publisher = topics.publisher(name, kind, M.SENSOR)
        simROS2.publisherTreatUInt8ArrayAsString(publisher)
        return publisher
    end

    --- A publisher of images, which are published compressed too.
    function topics.imagePublisher(name)
        local full = topics.resolve(name)
        local publisher = simROS2.imageTransportCreatePublisher(full, M.SENSOR.depth)
        note(full, function() simROS2.imageTransportShutdownPublisher(publisher) end)
        return publisher
    end

    function topics.subscription(name, kind, callback)
        local full = topics.resolve(name)
        local subscription = simROS2.createSubscription(full, kind, callback)
        note(full, function() simROS2.shutdownSubscription(subscription) end)
    end

    function topics.action(name, kind, ...)
        local full = topics.resolve(name)
        local server = simROS2.createActionServer(full, kind, ...)
        note(full, function() simROS2.shutdownActionServer(server) end)
        return server
    end

    --- The names of all topics, each once.
    function topics.all()
        local found, has = {}, {}
        for _, name in ipairs(names) do
            if not has[name] then found[#found + 1] = name end
            has[name] = true
        end
        return found
    end

    function topics.close()
        for _, shutDown in ipairs(handles) do pcall(shutDown) end
        handles, names = {}, {}
    end

    return topics
end

return M
