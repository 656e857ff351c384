--[[
What assertions share and a snapshot takes back: formatters, parameters, and the spies that stand in for functions.
]]

local state = {}

local formatters, spies = {}, {}
local parameters = {
    TableFormatLevel = 3,
    TableFormatShowRecursion = false,
    TableErrorHighlightCharacter = '*',
    TableErrorHighlightColor = 'none',
}

local function shallow(t)
    local copy = {}
    for key, value in pairs(t) do copy[key] = value end
    return copy
end

function state.add_formatter(formatter) formatters[#formatters + 1] = formatter end

function state.remove_formatter(formatter)
    for i = #formatters, 1, -1 do
        if formatters[i] == formatter then return table.remove(formatters, i) end
    end
end

--- What the newest formatter that knows the value makes of it.
function state.format(value, options)
    for i = #formatters, 1, -1 do
        local text = formatters[i](value, options)
        if text ~= nil then return text end
    end
end

function state.set_parameter(name, value) parameters[name] = value end
function state.get_parameter(name) return parameters[name] end
function state.add_spy(spy) spies[#spies + 1] = spy end

local function revert(snapshot)
    -- The newest first: it may stand in for another.
    while #spies > snapshot.spies do table.remove(spies):revert() end
    formatters, parameters = shallow(snapshot.formatters), shallow(snapshot.parameters)
end

--- What was said since can be taken back with `revert`.
function state.snapshot()
    return {spies = #spies, formatters = shallow(formatters), parameters = shallow(parameters), revert = revert}
end

return state
