--[[
Two versions of a controller in one text: lines that end with `-- right` or `-- broken` belong to one of them, all others to both.
]]

local sim = require('sim')
local t = require('swanilda.test')

local M = {}

local VERSIONS <const> = { 'right', 'broken' }

--- The text of a version.
function M.text(code, version)
    local lines = {}
    for line in code:gmatch('([^\n]*)\n?') do
        local only = line:match('%-%- (%a+)$')
        -- Lines keep their numbers.
        lines[#lines + 1] = (only ~= 'right' and only ~= 'broken' or only == version) and line or ''
    end
    return table.concat(lines, '\n')
end

--- Adds the script of a controller to the scene, in that version: a simulation script unless another type is given.
function M.script(code, version, kind)
    local handle = sim.createScript(kind or sim.scripttype_simulation, M.text(code, version))
    if kind == sim.scripttype_customization then sim.initScript(handle) end
    return t.script(handle)
end

--- A property of both versions.
function M.property(name, options, body)
    for _, version in ipairs(VERSIONS) do
        t.property(version .. ': ' .. name, options, function(g) body(g, version) end)
    end
end

return M
