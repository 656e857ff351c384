-- Begins the fault that the file 'fault' names, such as 'delayRequests 0.2', and ends it when the file is gone. The file 'active' is there meanwhile.
local fault

local function content(name)
    local file = io.open(FOLDER .. name)
    local text = file and file:read('a')
    if file then file:close() end
    return text
end

local function poll()
    local wanted = content('fault')
    if wanted and not fault then
        local kind, value = wanted:match('^(%a+) ?(%S*)$')
        fault = faults[kind](tonumber(value))
        io.open(FOLDER .. 'active', 'w'):close()
    elseif fault and not wanted then
        fault:stop()
        fault = nil
        os.remove(FOLDER .. 'active')
    end
    at(sim.getSimulationTime() + sim.getSimulationTimeStep(), poll)
end

FOLDER = sim.getNamedStringParam('folder') .. '/'
poll()
