--[[
Add-ons that start only if somebody wants it: `require('addOns.autoStart').setup{ns = 'name'}` in an add-on. It starts if the named parameter `name.autoStart` says so
(`-D name.autoStart=true`), else if it was set before (`set`), else as `default` says.

    get(options), set(options, on), setup(options)     options: ns, readNamedParam (true), default (false)
]]

local sim = _quietRequire 'sim'
local autoStart = {}

local YES <const> = {['true'] = true, ['1'] = true, on = true, yes = true}

local function tagOf(options) return 'customData.' .. options.ns .. '.autoStart' end

--- Whether the add-on starts by itself.
function autoStart.get(options)
    if options.readNamedParam ~= false then
        local named = sim.getNamedStringParam(options.ns .. '.autoStart')
        if named then return YES[tostring(named):lower()] or false end
    end
    local stored = sim.getBoolProperty(sim.handle_app, tagOf(options), {noError = true})
    if stored ~= nil then return stored end
    return options.default or false
end

--- Remembers whether it does.
function autoStart.set(options, on) sim.setBoolProperty(sim.handle_app, tagOf(options), on and true or false) end

--- Makes an add-on ask before it starts.
function autoStart.setup(options)
    if type(options) ~= 'table' or type(options.ns) ~= 'string' then error('missing field: ns', 2) end
    local info, init, suspend = sysCall_info, sysCall_init, sysCall_addOnScriptSuspend

    function sysCall_info()
        local result = info and info() or {}
        result.autoStart = autoStart.get(options)
        return result
    end

    function sysCall_init(...)
        autoStart.set(options, true)
        if init then return init(...) end
    end

    function sysCall_addOnScriptSuspend(...)
        autoStart.set(options, false)
        if suspend then return suspend(...) end
        return {cmd = 'cleanup'}
    end
end

return autoStart
